// Non-negative least squares through the Gram matrix (Lawson and Hanson 1974, chapter 23).
#pragma once

namespace redmap {

/// Most unknowns, and the row stride of the Gram matrices.
inline constexpr int kMaxUnknowns = 16;

/// Minimises |A w - v|^2 over w >= 0 for `count` unknowns, 0 to kMaxUnknowns: `gram` = A^T A with row stride
/// kMaxUnknowns, `projection` = A^T v, `weights` receives w. Columns that depend on each other share as they come.
/// Never allocates, never fails.
void solve_nnls(int count, const double* gram, const double* projection, double* weights);

}  // namespace redmap
