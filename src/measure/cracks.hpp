#pragma once
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "model/state.hpp"
#include "results/history.hpp"

namespace hibi {

/// Length of crack that one broken bond stands for (m), in a plane square lattice of spacing l0.
///
/// A straight crack of length a whose normal is n cuts a |b . n| / l0^2 bonds of vector b. Weighting each by
/// (angle between the neighbouring directions of bonds) / |b|, as in the Cauchy-Crofton formula, makes their
/// sum nearly the same for all n (Boykov & Kolmogorov 2003, Computing geodesics and minimal surfaces via
/// graph cuts). The scale makes a crack along the lattice count as a. Bonds of one direction share its weight
/// as they share its stiffness, by the MPS weight r_e/r - 1, so that a long, weak bond that fails late counts
/// little.
///
/// In between a crack is over-counted: for r_e below sqrt 5 spacings by 8.2 % at most, at 22.5 degrees to the
/// lattice, and 7.3 % at 15 and 30; for r_e up to sqrt 10 by 2.7 % at most, at 13 degrees. At 45 it is exact
/// to 0.1 %.
class CutLength {
 public:
    /// `influence` is r_e / l0, above sqrt 2.
    explicit CutLength(double influence);
    double operator()(double rest_length, double spacing) const;

 private:
    std::map<int, double> per_bond_;  ///< by |b|^2 / l0^2, in spacings
};

/// Follows the cracks of a run from break to break, in the reference configuration. Notches are no cracks.
///
/// A broken bond belongs to the crack that has another broken bond within r_e of it, middle to middle;
/// where there is none a crack begins, where there are several they become one, the oldest. The tip of a
/// crack is its broken bond farthest from the one it began with; the distance of the two is its reach. What
/// is reported as the tip is that of the leading crack: the one of largest reach, which stays so until
/// another is longer by r_e.
///
/// The speed is the slope of the leading crack's reach over time, a straight line fitted to its last ten
/// spacings of growth: long enough that steps of one spacing do not show. It is 0 until the crack has grown
/// by five. A crack that stands still slows down as time goes by without the next advance; what
/// breaks at once over more than r_e, or joins with another crack, begins the fit anew. Of a crack that
/// bends the speed is the part that leads away from where it began, a lower bound.
template <int Dim>
class Cracks {
 public:
    explicit Cracks(const Model<Dim>& model);

    /// Once a step with the bonds broken in it, which are no longer intact in the model.
    void grow(const Model<Dim>& model, std::span<const int> just_broken, double time);
    CrackReading read(double time) const;
    double top_speed() const { return top_speed_; }  ///< largest speed at any advance so far (m/s)

    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("length", self.length_);
        visit("top_speed", self.top_speed_);
        visit("leading", self.leading_);
        visit("cracks", self.cracks_);
        visit("crack_of", self.crack_of_);
    }

 private:
    struct Advance {
        double time = 0, reach = 0;

        template <class Self, class Visit>
        static void each_field(Self& self, Visit&& visit) {
            visit("time", self.time);
            visit("reach", self.reach);
        }
    };
    struct Crack {
        Vec<Dim> origin = Vec<Dim>::Zero(), tip = origin;
        double reach = 0;  ///< (m)
        double spacing = 0;
        std::deque<Advance> advances{};  ///< of the last ten spacings
        int merged_into = -1;

        template <class Self, class Visit>
        static void each_field(Self& self, Visit&& visit) {
            visit("origin", self.origin);
            visit("tip", self.tip);
            visit("reach", self.reach);
            visit("spacing", self.spacing);
            visit("advances", self.advances);
            visit("merged_into", self.merged_into);
        }
    };

    int oldest(int crack) const;
    int crack_of(const Model<Dim>& model, int bond);
    void advance(Crack& crack, const Vec<Dim>& tip, double reach, double time);
    double speed(const Crack& crack, double time) const;

    CutLength cut_length_;
    double influence_ = 0;
    double length_ = 0, top_speed_ = 0;
    int leading_ = -1;
    std::vector<Crack> cracks_;
    std::vector<int> crack_of_;  ///< per bond, or -1
};

/// Connected parts of the model: particles joined by intact bonds. A particle without any is debris.
template <int Dim>
Fragments find_fragments(const Model<Dim>& model, const State<Dim>& state);

extern template class Cracks<2>;
extern template Fragments find_fragments<2>(const Model<2>&, const State<2>&);

}  // namespace hibi
