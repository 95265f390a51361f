#pragma once
#include <Eigen/SparseCore>
#include <memory>

namespace hibi {

/// A pivot this small beside the diagonal of the matrix is rounding: the matrix is singular.
inline constexpr double singular_pivot = 1e-11;

/// Factor of a symmetric positive definite matrix whose pattern never changes (CHOLMOD, supernodal, nested
/// dissection). The same bits on any number of threads: BLAS is kept to one.
class Cholesky {
 public:
    /// Orders the matrix, given by its lower triangle. Entries above the diagonal are ignored.
    explicit Cholesky(const Eigen::SparseMatrix<double>& lower);
    ~Cholesky();
    Cholesky(Cholesky&&) noexcept;
    Cholesky& operator=(Cholesky&&) noexcept;

    /// Returns whether the matrix is positive definite. Throws std::runtime_error where memory ends.
    bool factorise(const Eigen::SparseMatrix<double>& lower);
    void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x);

    /// The row whose pivot is smallest relative to the diagonal of the matrix, and that ratio.
    struct Pivot {
        int row = -1;
        double ratio = 1;
    };
    Pivot weakest(const Eigen::SparseMatrix<double>& lower) const;

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace hibi
