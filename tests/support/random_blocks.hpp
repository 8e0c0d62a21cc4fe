// Random sparse block matrices.
#pragma once

#include "framework/core/block_matrix.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"

namespace tack {

MatX dense(const BlockMatrix& matrix);

// Diagonally dominant, with about `neighbours` blocks below each diagonal one.
BlockMatrix random_spd(int columns, RandomMotions& random, int neighbours = 4);

// A grid of n^3 nodes, each coupled to its next neighbours by random blocks.
BlockMatrix grid(int n, RandomMotions& random, double stiffest = 1);

}  // namespace tack
