// SPDX-License-Identifier: GPL-2.0-or-later
#include "grain_state.h"
#include "atom.h"
#include <cstddef>

namespace grainscope {

namespace {

/** FNV-1a of the bits of numbers, as one that is a double without loss. */
class Hash {
 public:
  void add_bytes(const void *from, std::size_t n) {
    const unsigned char *bytes = static_cast<const unsigned char *>(from);
    for (std::size_t k = 0; k < n; k++) h_ = (h_ ^ bytes[k]) * 1099511628211u;
  }
  void add(const double *values, int n) { add_bytes(values, n * sizeof(double)); }
  void add(double value) { add(&value, 1); }
  std::uint64_t bits() const { return h_; }
  double value() const { return static_cast<double>(h_ >> 11); }

 private:
  std::uint64_t h_ = 14695981039346656037u;
};

}

double velocity_hash(const LAMMPS_NS::Atom *atom, int i) {
  Hash hash;
  hash.add(atom->v[i], 3);
  return hash.value();
}

double state_hash(const LAMMPS_NS::Atom *atom, int i) {
  Hash hash;
  hash.add(atom->omega[i], 3);
  hash.add(atom->radius[i]);
  hash.add(atom->rmass[i]);
  hash.add(atom->type[i]);
  if (atom->superquadric_flag) {
    hash.add(atom->quaternion[i], 4);
    hash.add(atom->angmom[i], 3);
    hash.add(atom->shape[i], 3);
    hash.add(atom->blockiness[i], 2);
  }
  return hash.value();
}

std::uint64_t text_hash(const std::string &text) {
  Hash hash;
  hash.add_bytes(text.data(), text.size());
  return hash.bits();
}

void edges_crossed(LAMMPS_NS::tagint before, LAMMPS_NS::tagint after, int edges[3]) {
  for (int k = 0; k < 3; k++) {
    const int shift = k == 0 ? 0 : k == 1 ? IMGBITS : IMG2BITS;
    const int n = static_cast<int>(((after >> shift) & IMGMASK) - ((before >> shift) & IMGMASK));
    // Flags count modulo their number of bits.
    edges[k] = n > IMGMAX ? n - (IMGMASK + 1) : n < -IMGMAX ? n + (IMGMASK + 1) : n;
  }
}

}
