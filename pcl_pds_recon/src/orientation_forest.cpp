// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/orientation_forest.h>
#include <utility>

namespace pds
{

void OrientationForest::resize(std::size_t count)
{
  const std::size_t before = parent_.size();
  parent_.resize(count);
  flip_.resize(count, 0);
  size_.resize(count, 1);
  for (std::size_t face = before; face < count; ++face) parent_[face] = static_cast<std::uint32_t>(face);
}

void OrientationForest::undo(std::size_t count)
{
  for (auto link = undo_.rbegin(); link != undo_.rend(); ++link) {
    size_[parent_[link->face]] = link->parent_size;
    parent_[link->face] = link->face;
    flip_[link->face] = 0;
  }
  undo_.clear();
  resize(count);
}

OrientationForest::Root OrientationForest::root_of(std::uint32_t face) const
{
  bool flipped = false;
  while (parent_[face] != face) {
    flipped ^= flip_[face] != 0;
    face = parent_[face];
  }
  return {face, flipped};
}

void OrientationForest::join(std::uint32_t a, std::uint32_t b, bool opposed)
{
  Root small = root_of(a);
  Root large = root_of(b);
  if (small.face == large.face) return;
  if (size_[small.face] > size_[large.face]) std::swap(small, large);
  undo_.push_back({small.face, size_[large.face]});
  parent_[small.face] = large.face;
  flip_[small.face] = static_cast<std::uint8_t>(small.flipped ^ large.flipped ^ opposed);
  size_[large.face] += size_[small.face];
}

void OrientationForest::isolate(std::uint32_t face)
{
  parent_[face] = face;
  flip_[face] = 0;
  size_[face] = 1;
}

void OrientationForest::hang(std::uint32_t face, std::uint32_t root, bool flipped)
{
  parent_[face] = root;
  flip_[face] = flipped ? 1 : 0;
  ++size_[root];
}

}  // namespace pds
