#pragma once
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "model/model.hpp"
#include "physics/cholesky.hpp"
#include "physics/elastic.hpp"
#include "physics/physics.hpp"
#include "physics/softest_mode.hpp"
#include "physics/tangent.hpp"

namespace hibi {

/// Components that a support holds or a load drives.
template <int Dim>
std::vector<std::array<bool, 3>> held_components(int particles, const Physics& physics);

/// Which particles a chain of intact bonds ties to one that is held in some direction.
std::vector<char> tied_to_support(const Bonds& bonds, const std::vector<std::array<bool, 3>>& held);

/// What became of a search for equilibrium.
struct Settled {
    bool found = false;
    bool stopped = false;    ///< by `enough`, before equilibrium was found
    bool senseless = false;  ///< not found where the body keeps within what a linear law can stand for
    bool smooth = true;      ///< no tangent on the way was indefinite: the body did not snap to another shape
    int newton_steps = 0;
    double residual = 0;  ///< out-of-balance force over the applied and reaction forces [-]; 0 where all of
                          ///< them are rounding
    int gave_way = -1;    ///< where no equilibrium was found: the particle that had gone farthest by then

    /// An equilibrium that the slightest disturbance destroys.
    struct Unstable {
        double share = 0;   ///< of the way from the start of the search, where stability was lost, 0 to 1
        int particle = -1;  ///< that gives way most
    };
    std::optional<Unstable> unstable{};  ///< such a one was found first, and left
};

/// Static equilibrium of the moment-matched model under dead loads, by Newton's method on the potential
/// energy. The linear systems are solved by conjugate gradients, preconditioned by the last factor of a
/// tangent: one factor serves many steps, loads and broken bonds, until it takes too many iterations.
template <int Dim>
class Equilibrium {
 public:
    /// Of `held[i][a]`, component a of particle i, the displacement is given. Throws std::runtime_error where
    /// something can move freely, at the current displacements and with the bonds that are intact now.
    /// Particles without bonds are left where they are.
    Equilibrium(const Model<Dim>& model, std::vector<std::array<bool, 3>> held);

    /// Moves the free components until the forces of `law` and `applied` (N, per particle) balance; `moved`,
    /// if not empty, says by how much held components move on the way (m). The model is left in equilibrium,
    /// or, where none is found, as it was. Bonds may have broken since the last call. After every step down
    /// the energy `enough`, if given, is asked whether to stop there.
    Settled find(Model<Dim>& model, ElasticLaw<Dim>& law, const std::vector<Vec<Dim>>& applied,
                 const std::vector<Vec<Dim>>& moved = {}, const std::function<bool()>& enough = {});

    /// The same, but an equilibrium that is no minimum of the energy, such as a straight column beyond its
    /// Euler load, is left along its softest mode, down the energy, for another one. Where a body is so
    /// symmetric that it could go to either side as well, it goes to the one where that mode is positive.
    Settled find_stable(Model<Dim>& model, ElasticLaw<Dim>& law, const std::vector<Vec<Dim>>& applied,
                        const std::vector<Vec<Dim>>& moved = {}, const std::function<bool()>& enough = {});

    /// Displacements from which the last step of find() started (m).
    const std::vector<Vec<Dim>>& before_last_step() const { return before_step_; }

    /// The particle stays where it is from now on.
    void hold(int particle);
    const std::vector<std::array<bool, 3>>& held() const { return held_; }

    /// Relative out-of-balance force that counts as equilibrium; rounding sets a floor of its own.
    double tolerance = 1e-10;

    int factorisations() const { return factorisations_; }
    int iterations() const { return iterations_; }  ///< of conjugate gradients, each one solve by the factor

 private:
    void balance(const Model<Dim>& model, const std::vector<Vec<Dim>>& applied);
    bool factorise();
    bool newton_step(double accuracy, bool& smooth);
    bool conjugate_gradients(double accuracy, int most);
    double potential(const Model<Dim>& model, const ElasticLaw<Dim>& law,
                     const std::vector<Vec<Dim>>& applied);
    bool is_unstable();
    /// What rounding may make of the energies compared last (J).
    double slack_of_potential() const { return 1e-12 * largest_potential_; }
    double fall_along_mode(Model<Dim>& model, const ElasticLaw<Dim>& law,
                           const std::vector<Vec<Dim>>& applied);
    Settled follow_mode(Model<Dim>& model, ElasticLaw<Dim>& law, const std::vector<Vec<Dim>>& applied,
                        double length, const std::function<bool()>& enough);
    double multiply_free(const Eigen::VectorXd& x, Eigen::VectorXd& Kx) const;
    bool search_along_step(Model<Dim>& model, ElasticLaw<Dim>& law, const std::vector<Vec<Dim>>& applied);

    std::vector<std::array<bool, 3>> held_;
    Tangent<Dim> tangent_;
    std::optional<Cholesky> cholesky_;
    bool factorised_ = false;
    double extent_ = 0;                ///< of all bodies together (m)
    double least_force_ = 0;           ///< below it a force is none (N)
    Eigen::VectorXd stiffness_;        ///< diagonal of the last assembled tangent (N/m)
    Eigen::VectorXd residual_, step_;  ///< out-of-balance forces (N), 0 where held; Newton step (m)
    double scale_ = 0, floor_ = 0;     ///< applied and reaction forces; what rounding leaves of them (N)
    double largest_potential_ = 0;     ///< of the parts of the last energies compared (J)
    double last_shift_ = 0;            ///< with which the tangent was positive definite
    std::vector<Vec<Dim>> before_step_;
    SoftestMode softest_;
    double theta_ = 1;      ///< of softest_, at the last state that was asked for
    int softest_uses_ = 0;  ///< the factor with this number
    int factorisations_ = 0, iterations_ = 0;
};

extern template class Equilibrium<2>;

}  // namespace hibi
