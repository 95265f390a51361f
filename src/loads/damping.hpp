#pragma once
#include "physics/interaction.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Mass-proportional damping: sets the rate in the State. How it slows the particles down is part of the kick
/// of VelocityVerlet.
template <int Dim>
class MassDamping final : public Interaction<Dim> {
 public:
    MassDamping(const Model<Dim>& model, const Physics& physics) : model_(model), physics_(physics) {}
    /// Throws std::runtime_error for a ratio on a free body.
    void start(State<Dim>& state) override;

 private:
    const Model<Dim>& model_;
    const Physics& physics_;
};

}  // namespace hibi
