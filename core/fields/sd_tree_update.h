// The update of an SD-tree: pending sums become learned radiance, and both kinds of trees are built anew from it.
// [Mueller et al. 2017, section 3]
#pragma once

#include "core/fields/sd_tree_model.h"

namespace pl {

/// Share of a leaf's energy above which a quadrant is divided.   [Mueller et al. 2017: rho = 0.01]
inline constexpr float kDividedShare = 0.01f;

/// Training samples of a leaf above which it is split: kSplitSamples sqrt(n / kSplitReference), n those of all leaves, and at least
/// kFewestSplitSamples. In the paper c sqrt(2^k) in iteration k, whose samples have doubled so often; the reference is the
/// number of a first iteration, four paths for each of a million pixels. c is 12 000 in 2017 and 4000 in 2019.
inline constexpr double kSplitSamples = 4000.0;
inline constexpr double kSplitReference = 16777216.0;
inline constexpr double kFewestSplitSamples = 2000.0;

/// Training samples that a quadrant is to have, on the mean, before it is divided: fewer say nothing of its quarters. Leaves of the
/// first updates are small; the paper's have thousands. Measured from 8 to 100, see docs/notebook/2026-11-25-sd-tree.md.
inline constexpr float kFewestInQuadrant = 60.0f;

/// Absorbs all pending sums, splits leaves by their number of training samples, and divides or joins quadrants by their energy. A
/// tree that would have more than shape.most_nodes nodes gets fewer leaves, and quadrants by a larger share. The same bits for
/// any number of threads.
void update_sd_tree(const FieldShape& shape, HostSdTree& tree, int threads);

}  // namespace pl
