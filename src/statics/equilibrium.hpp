#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "algebra/cholesky.hpp"
#include "algebra/softest_mode.hpp"
#include "elasticity/elastic_law.hpp"
#include "elasticity/tangent.hpp"
#include "loads/supports.hpp"
#include "physics/interaction.hpp"

namespace hibi {

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
    /// Of `held[i][a]`, component a of particle i, the displacement is given. `law` must have a tangent and
    /// outlive this. Throws std::runtime_error where something can move freely, at the displacements of
    /// `state` and with the bonds that are intact there. Particles without bonds are left where they are.
    Equilibrium(const Model<Dim>& model, ElasticLaw<Dim>& law, const State<Dim>& state, HeldComponents held);

    /// Moves the free components until the forces of the law and `loads.applied` balance, while held
    /// components move by `loads.moved` (may be empty). The state is left in equilibrium, or, where none is
    /// found, as it was. Bonds may have broken since the last call. After every step down the energy
    /// `enough`, if given, is asked whether to stop there.
    Settled find(State<Dim>& state, const StaticLoads<Dim>& loads, const std::function<bool()>& enough = {});

    /// The same, but an equilibrium that is no minimum of the energy, such as a straight column beyond its
    /// Euler load, is left along its softest mode, down the energy, for another one. Where a body is so
    /// symmetric that it could go to either side as well, it goes to the one where that mode is positive.
    Settled find_stable(State<Dim>& state, const StaticLoads<Dim>& loads,
                        const std::function<bool()>& enough = {});

    /// Displacements from which the last step of find() started (m).
    const std::vector<Vec<Dim>>& before_last_step() const { return before_step_; }

    /// The particle stays where it is from now on.
    void hold(int particle);
    const HeldComponents& held() const { return held_; }

    /// What a search keeps for the next one: where the factor at hand was made, and the softest mode. With it,
    /// one Equilibrium goes on where another has stopped, to the last bit. One of the same model and supports;
    /// fragments must have been held before.
    struct Memory {
        bool factorised = false;               ///< is there a factor that may be used?
        std::vector<Vec<Dim>> displacement;    ///< where it was made (m)
        std::vector<char> intact;              ///< the bonds it was made with
        double shift = 0;                      ///< with which the tangent was positive definite
        Eigen::VectorXd stiffness;             ///< diagonal of the last assembled tangent (N/m)
        bool knows_softest = false;            ///< does the softest mode belong to that factor?
        Eigen::VectorXd softest, softest_image;
    };
    const Memory& memory();
    void restore(const State<Dim>& state, Memory memory);

    /// Relative out-of-balance force that counts as equilibrium; rounding sets a floor of its own.
    double tolerance = 1e-10;

    int factorisations() const { return factorisations_; }
    int iterations() const { return iterations_; }  ///< of conjugate gradients, each one solve by the factor

 private:
    void balance(const State<Dim>& state, const std::vector<Vec<Dim>>& applied);
    bool factorise(const State<Dim>& state);
    bool newton_step(const State<Dim>& state, double accuracy, bool& smooth);
    bool conjugate_gradients(double accuracy, int most);
    double potential(const State<Dim>& state, const std::vector<Vec<Dim>>& applied);
    bool is_unstable();
    const Eigen::SparseMatrix<double>& assemble(const State<Dim>& state);
    Eigen::VectorXd free_components() const;
    /// What rounding may make of the energies compared last (J).
    double slack_of_potential() const { return 1e-12 * largest_potential_; }
    double fall_along_mode(State<Dim>& state, const std::vector<Vec<Dim>>& applied);
    Settled follow_mode(State<Dim>& state, const std::vector<Vec<Dim>>& applied, double length,
                        const std::function<bool()>& enough);
    double multiply_free(const Eigen::VectorXd& x, Eigen::VectorXd& Kx) const;
    bool search_along_step(State<Dim>& state, const std::vector<Vec<Dim>>& applied);

    const Model<Dim>& model_;
    ElasticLaw<Dim>& law_;
    HeldComponents held_;
    std::unique_ptr<Tangent<Dim>> tangent_;
    std::optional<Cholesky> cholesky_;
    Memory memory_;
    double extent_ = 0;                ///< of all bodies together (m)
    double least_force_ = 0;           ///< below it a force is none (N)
    Eigen::VectorXd residual_, step_;  ///< out-of-balance forces (N), 0 where held; Newton step (m)
    double scale_ = 0, floor_ = 0;     ///< applied and reaction forces; what rounding leaves of them (N)
    double largest_potential_ = 0;     ///< of the parts of the last energies compared (J)
    std::vector<Vec<Dim>> before_step_;
    SoftestMode softest_;
    double theta_ = 1;      ///< of softest_, at the last state that was asked for
    int factorisations_ = 0, iterations_ = 0;
};

extern template class Equilibrium<2>;

}  // namespace hibi
