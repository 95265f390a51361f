#pragma once

namespace hibi {

/// One function out of several, for std::visit.
template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};

}  // namespace hibi
