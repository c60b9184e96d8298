// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_local.h"
#include "arguments.h"
#include "contact_measures.h"
#include "contact_observer.h"
#include "contact_sums.h"
#include "force_statistics.h"
#include "atom.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using grainscope::Contact;

namespace {

struct Row {
  const Contact &contact;
  const double *image;
  int id_i, id_j;  // id_j is 0 for a wall
};

const double no_shift[3] = {0.0, 0.0, 0.0};

double *put(double *at, const Vector3d &v) { return std::copy(v.data(), v.data() + 3, at); }

constexpr auto intensive = grainscope::Extent::intensive;

/** The columns of one keyword: outputs named after `parts`, none for a single one. */
struct Column {
  const char *name, *parts, *unit, *meaning;
  void (*write)(const Row &, double *);
  bool reads_motion = false;  // Contact::motion

  grainscope::OutputList outputs() const {
    const std::string whole = name;
    if (!*parts) return {{whole, unit, intensive, meaning}};
    return grainscope::OutputList().add_each(parts, {whole + "_*", unit, intensive, std::string(meaning) + " *"});
  }
};

const char *const xyz = "x y z", *const one = "";

/** Written when all contacts are known. */
void after_all(const Row &, double *to) { *to = 0.0; }

const Column columns[] = {
    {"id", "i j", "-", "ID of grain",
     [](const Row &r, double *to) {
       to[0] = r.id_i;
       to[1] = r.id_j;
     }},
    {"image", xyz, "-", "periodic image of j that i touches, in box edges,",
     [](const Row &r, double *to) { std::copy(r.image, r.image + 3, to); }},
    {"point", xyz, "distance", "contact point,", [](const Row &r, double *to) { put(to, r.contact.motion->point); },
     true},
    {"normal", xyz, "-", "unit normal from j to i,", [](const Row &r, double *to) { put(to, r.contact.normal); }},
    {"branch", xyz, "distance", "x_i - x_j with that image,",
     [](const Row &r, double *to) { put(to, r.contact.branch); }},
    {"overlap", one, "distance", "normal overlap", [](const Row &r, double *to) { *to = r.contact.overlap; }},
    {"force", xyz, "force", "force on i,", [](const Row &r, double *to) { put(to, r.contact.force); }},
    {"fn", one, "force", "normal component of the force, > 0 pushes apart",
     [](const Row &r, double *to) { *to = r.contact.normal_force; }},
    {"fn_damping", one, "force", "damping part of fn",
     [](const Row &r, double *to) { *to = r.contact.motion->normal_damping; }, true},
    {"ft", xyz, "force", "tangential force on i,",
     [](const Row &r, double *to) { put(to, r.contact.tangential_force); }},
    {"un", one, "velocity", "normal velocity of i relative to j, < 0 approaching",
     [](const Row &r, double *to) { *to = r.contact.motion->normal_velocity; }, true},
    {"ut", xyz, "velocity", "tangential velocity of i relative to j at the contact point,",
     [](const Row &r, double *to) { put(to, r.contact.motion->tangential_velocity); }, true},
    {"sliding", one, "-", "1 if the spring was cut at the friction limit, else 0",
     [](const Row &r, double *to) { *to = r.contact.sliding; }},
    {"slip", one, "distance", "length cut from the tangential spring",
     [](const Row &r, double *to) { *to = r.contact.slip; }},
    {"mobilisation", one, "-", "|F_t| over its friction limit",
     [](const Row &r, double *to) { *to = grainscope::mobilisation(r.contact); }, true},
    {"wall", one, "-", "number of the wall, from 1, 0 for a grain",
     [](const Row &r, double *to) { *to = r.contact.with_wall() ? r.contact.wall().wall + 1 : 0; }},
    {"triangle", one, "-", "ID of the wall's triangle, from 0, -1 for none",
     [](const Row &r, double *to) { *to = r.contact.with_wall() ? r.contact.wall().triangle : -1; }},
    {"strong", one, "-", "1 if fn is above the mean of all rows, else 0", after_all},
    {"cluster", one, "-", "lowest ID of the grains that strong contacts connect with i, 0 when not strong", after_all}};

/** The default columns: scripts count them. */
const int usual_columns = 15;

}

struct ComputeContactLocal::Impl {
  struct Chosen {
    const Column *column;
    int width;
  };
  std::vector<Chosen> chosen;
  int width = 0;
  std::vector<double> values;  // the rows, one after the other
  std::vector<double *> rows;

  // Of the columns that are written when all contacts are known
  int strong = -1, cluster = -1;  // places in a row; -1: not asked for
  bool ranks_forces() const { return strong >= 0 || cluster >= 0; }
  std::vector<double> normal_forces;
  std::vector<ContactNetworkCompute::Link> links;
};

ComputeContactLocal::ComputeContactLocal(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactNetworkCompute(lmp, iarg, narg, arg,
                            grainscope::Scope::region | grainscope::Scope::types | grainscope::Scope::walls),
      impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  std::vector<std::string> names;
  for (const Column &column : columns) names.push_back(column.name);
  names = scope_.with(names);
  while (!arguments.done()) {
    const std::string name = arguments.keyword(names, "column");
    if (scope_.read(arguments, name)) continue;
    const auto same = [&name](const Column &column) { return name == column.name; };
    impl_->chosen.push_back({std::find_if(std::begin(columns), std::end(columns), same), 0});
  }
  if (impl_->chosen.empty())
    for (int k = 0; k < usual_columns; k++) impl_->chosen.push_back({&columns[k], 0});
  grainscope::Outputs outputs;
  for (Impl::Chosen &one : impl_->chosen) {
    const grainscope::OutputList list = one.column->outputs();
    outputs.local.insert(outputs.local.end(), list.begin(), list.end());
    one.width = list.size();
    if (!strcmp(one.column->name, "strong")) impl_->strong = impl_->width;
    if (!strcmp(one.column->name, "cluster")) impl_->cluster = impl_->width;
    impl_->width += one.width;
  }
  declare(this, outputs);
}

ComputeContactLocal::~ComputeContactLocal() {}

/** Clusters are of clumps. */
bool ComputeContactLocal::uses_bodies() const { return impl_->cluster >= 0; }

bool ComputeContactLocal::reads_motion() const {
  return std::any_of(impl_->chosen.begin(), impl_->chosen.end(),
                     [](const Impl::Chosen &one) { return one.column->reads_motion; });
}

void ComputeContactLocal::begin_contacts() {
  ContactNetworkCompute::begin_contacts();
  impl_->values.clear();
  impl_->normal_forces.clear();
  impl_->links.clear();
}

void ComputeContactLocal::add_contacts(grainscope::ContactSpan contacts) {
  grainscope::for_each_contact(contacts, selection(), [this](const Contact &c) {
    if (is_mine(c)) add_row(c);
  });
}

void ComputeContactLocal::add_row(const Contact &c) {
  const Row row = c.with_wall() ? Row{c, no_shift, atom->tag[c.i], 0}
                                : Row{c, observer_->image_shift(c.j()), atom->tag[c.i], atom->tag[c.j()]};
  impl_->values.resize(impl_->values.size() + impl_->width);
  double *to = impl_->values.data() + impl_->values.size() - impl_->width;
  for (const Impl::Chosen &one : impl_->chosen) {
    one.column->write(row, to);
    to += one.width;
  }
  if (!impl_->ranks_forces()) return;
  impl_->normal_forces.push_back(c.normal_force);
  impl_->links.push_back(link(c));
}

void ComputeContactLocal::end_contacts() {
  Impl &my = *impl_;
  if (!my.ranks_forces()) return;
  double sums[2] = {std::accumulate(my.normal_forces.begin(), my.normal_forces.end(), 0.0),
                    static_cast<double>(my.normal_forces.size())};
  sum_over_ranks(sums, 2);
  const double mean = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
  std::vector<Link> strong;
  for (std::size_t row = 0; row < my.links.size(); row++)
    if (grainscope::is_strong(my.normal_forces[row], mean)) strong.push_back(my.links[row]);
  const std::vector<double> cluster = my.cluster < 0 ? std::vector<double>() : clusters(strong);
  for (std::size_t row = 0; row < my.links.size(); row++) {
    if (!grainscope::is_strong(my.normal_forces[row], mean)) continue;
    double *values = &my.values[row * my.width];
    if (my.strong >= 0) values[my.strong] = 1.0;
    if (my.cluster >= 0) values[my.cluster] = cluster[number_of(my.links[row].i)];
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

double ComputeContactLocal::memory_usage() {
  return impl_->values.capacity() * sizeof(double) + impl_->rows.capacity() * sizeof(double *);
}
