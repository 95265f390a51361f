#include "algebra/cholesky.hpp"

#include <cholmod.h>
#include <dlfcn.h>

#include <stdexcept>

namespace hibi {

namespace {

/// CHOLMOD's own copyless view of a matrix.
cholmod_sparse view(const Eigen::SparseMatrix<double>& lower) {
    cholmod_sparse A{};
    A.nrow = static_cast<std::size_t>(lower.rows());
    A.ncol = static_cast<std::size_t>(lower.cols());
    A.nzmax = static_cast<std::size_t>(lower.nonZeros());
    A.p = const_cast<int*>(lower.outerIndexPtr());
    A.i = const_cast<int*>(lower.innerIndexPtr());
    A.x = const_cast<double*>(lower.valuePtr());
    A.stype = -1;
    A.itype = CHOLMOD_INT;
    A.xtype = CHOLMOD_REAL;
    A.dtype = CHOLMOD_DOUBLE;
    A.sorted = A.packed = 1;
    return A;
}

/// The sums of a BLAS with threads of its own depend on their number, and they would fight with ours.
void keep_blas_to_one_thread() {
    using SetThreads = void (*)(int);
    if (void* found = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<SetThreads>(found)(1);
}

}  // namespace

struct Cholesky::Parts {
    cholmod_common common{};
    cholmod_factor* factor = nullptr;
    cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;  // solve keeps its memory between calls

    Parts() {
        keep_blas_to_one_thread();
        cholmod_start(&common);
        common.print = 0;
        common.supernodal = CHOLMOD_SUPERNODAL;
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_METIS;
        common.postorder = 1;
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    ~Parts() {
        cholmod_free_dense(&x, &common);
        cholmod_free_dense(&y, &common);
        cholmod_free_dense(&e, &common);
        cholmod_free_factor(&factor, &common);
        cholmod_finish(&common);
    }
    void require_memory() const {
        if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
            throw std::runtime_error("the factor of the stiffness matrix does not fit into memory");
        if (common.status < 0) throw std::runtime_error("CHOLMOD cannot factorise the stiffness matrix");
    }
};

Cholesky::Cholesky(const Eigen::SparseMatrix<double>& lower) : parts_(std::make_unique<Parts>()) {
    cholmod_sparse A = view(lower);
    parts_->factor = cholmod_analyze(&A, &parts_->common);
    parts_->require_memory();
}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

bool Cholesky::factorise(const Eigen::SparseMatrix<double>& lower) {
    cholmod_sparse A = view(lower);
    cholmod_factorize(&A, parts_->factor, &parts_->common);
    parts_->require_memory();
    return parts_->common.status != CHOLMOD_NOT_POSDEF && parts_->factor->minor == parts_->factor->n;
}

void Cholesky::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
    cholmod_dense B{};
    B.nrow = B.nzmax = B.d = static_cast<std::size_t>(b.size());
    B.ncol = 1;
    B.x = const_cast<double*>(b.data());
    B.xtype = CHOLMOD_REAL;
    B.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, parts_->factor, &B, nullptr, &parts_->x, nullptr, &parts_->y, &parts_->e,
                   &parts_->common);
    parts_->require_memory();
    x = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(parts_->x->x), b.size());
}

Cholesky::Pivot Cholesky::weakest(const Eigen::SparseMatrix<double>& lower) const {
    const cholmod_factor& L = *parts_->factor;
    const int *super = static_cast<const int*>(L.super), *rows = static_cast<const int*>(L.pi),
              *values = static_cast<const int*>(L.px), *order = static_cast<const int*>(L.Perm);
    const double* x = static_cast<const double*>(L.x);
    const Eigen::VectorXd diagonal = lower.diagonal();
    Pivot pivot;
    for (std::size_t s = 0; s < L.nsuper; ++s) {
        const int height = rows[s + 1] - rows[s];
        for (int column = super[s]; column < super[s + 1]; ++column) {
            const double root = x[values[s] + static_cast<std::ptrdiff_t>(column - super[s]) * (height + 1)];
            const int row = order[column];
            const double ratio = root * root / diagonal[row];
            if (ratio < pivot.ratio) pivot = {row, ratio};
        }
    }
    return pivot;
}

}  // namespace hibi
