// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_local.h"
#include "arguments.h"
#include "contact_measures.h"
#include "contact_observer.h"
#include "contact_sums.h"
#include "atom.h"
#include "update.h"
#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using grainscope::Contact;

namespace {

struct Row {
  const Contact &contact;
  const double *image;
  int id_i, id_j;
};

double *put(double *at, const Vector3d &v) { return std::copy(v.data(), v.data() + 3, at); }

struct Column {
  const char *name;
  int width;
  void (*write)(const Row &, double *);
};

const Column columns[] = {
    {"id", 2, [](const Row &r, double *to) { to[0] = r.id_i; to[1] = r.id_j; }},
    {"image", 3, [](const Row &r, double *to) { std::copy(r.image, r.image + 3, to); }},
    {"point", 3, [](const Row &r, double *to) { put(to, r.contact.motion->point); }},
    {"normal", 3, [](const Row &r, double *to) { put(to, r.contact.normal); }},
    {"branch", 3, [](const Row &r, double *to) { put(to, r.contact.branch); }},
    {"overlap", 1, [](const Row &r, double *to) { *to = r.contact.overlap; }},
    {"force", 3, [](const Row &r, double *to) { put(to, r.contact.force); }},
    {"fn", 1, [](const Row &r, double *to) { *to = r.contact.normal_force; }},
    {"fn_damping", 1, [](const Row &r, double *to) { *to = r.contact.motion->normal_damping; }},
    {"ft", 3, [](const Row &r, double *to) { put(to, r.contact.tangential_force); }},
    {"un", 1, [](const Row &r, double *to) { *to = r.contact.motion->normal_velocity; }},
    {"ut", 3, [](const Row &r, double *to) { put(to, r.contact.motion->tangential_velocity); }},
    {"sliding", 1, [](const Row &r, double *to) { *to = r.contact.sliding; }},
    {"slip", 1, [](const Row &r, double *to) { *to = r.contact.slip; }},
    {"mobilisation", 1, [](const Row &r, double *to) { *to = grainscope::mobilisation(r.contact); }}};

}

struct ComputeContactLocal::Impl {
  std::vector<const Column *> chosen;
  int width = 0;
  std::vector<double> values;    // the rows, one after the other
  std::vector<double *> rows;
};

ComputeContactLocal::ComputeContactLocal(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg), impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  const bool all = arguments.done();
  std::vector<std::string> names;
  for (const Column &column : columns) {
    names.push_back(column.name);
    if (all) impl_->chosen.push_back(&column);
  }
  while (!arguments.done()) {
    const std::string name = arguments.keyword(names, "column");
    impl_->chosen.push_back(std::find_if(std::begin(columns), std::end(columns), [&](const Column &c) { return name == c.name; }));
  }
  for (const Column *column : impl_->chosen) impl_->width += column->width;
  local_flag = 1;
  size_local_cols = impl_->width == 1 ? 0 : impl_->width;
  size_local_rows = 0;
}

ComputeContactLocal::~ComputeContactLocal() {}

/** Of a contact that two owners see (or one owner twice, through an image of itself), the lower ID writes the row; between two images of one
 *  grain, the one whose partner lies toward the positive side. */
bool ComputeContactLocal::is_mine(const Contact &c) const {
  const int j = c.j();
  if (!c.ghost()) return true;
  if (atom->tag[c.i] != atom->tag[j]) return atom->tag[c.i] < atom->tag[j];
  const double *shift = observer_->image_shift(j);
  const double origin[3] = {0.0, 0.0, 0.0};
  return std::lexicographical_compare(origin, origin + 3, shift, shift + 3);
}

void ComputeContactLocal::begin_contacts() { impl_->values.clear(); }

void ComputeContactLocal::add_contacts(grainscope::ContactSpan contacts) {
  grainscope::for_each_contact(contacts, of_group(), [this](const Contact &c) {
    if (is_mine(c)) add_row(c);
  });
}

void ComputeContactLocal::add_row(const Contact &c) {
  const Row row = {c, observer_->image_shift(c.j()), atom->tag[c.i], atom->tag[c.j()]};
  impl_->values.resize(impl_->values.size() + impl_->width);
  double *to = impl_->values.data() + impl_->values.size() - impl_->width;
  for (const Column *column : impl_->chosen) {
    column->write(row, to);
    to += column->width;
  }
}

void ComputeContactLocal::compute_local() {
  require_tally();
  invoked_local = update->ntimestep;
  size_local_rows = impl_->values.size() / impl_->width;
  impl_->rows.resize(size_local_rows);
  for (int row = 0; row < size_local_rows; row++) impl_->rows[row] = &impl_->values[row * impl_->width];
  vector_local = impl_->values.data();
  array_local = impl_->rows.data();
}

double ComputeContactLocal::memory_usage() { return impl_->values.capacity() * sizeof(double) + impl_->rows.capacity() * sizeof(double *); }
