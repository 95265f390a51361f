#pragma once
#include <cstddef>
#include <set>

namespace hibi::test {

/// Stands for a value of any type in an initialiser that is only looked at, never run.
struct Anything {
    template <class T>
    operator T() const;
};

/// How many members an aggregate has: the most values that its braces take. Asks the compiler, and not the
/// list that is to be judged.
template <class T, class... Values>
constexpr std::size_t member_count() {
    if constexpr (requires { T{Values{}..., Anything{}}; })
        return member_count<T, Values..., Anything>();
    else
        return sizeof...(Values);
}

/// How many different fields of the value its list names.
template <class T>
std::size_t listed_fields(const T& value) {
    std::set<const void*> places;
    T::each_field(value, [&](const char*, const auto& field) { places.insert(&field); });
    return places.size();
}

}  // namespace hibi::test
