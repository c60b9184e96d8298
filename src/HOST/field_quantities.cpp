// SPDX-License-Identifier: GPL-2.0-or-later
#include "field_quantities.h"
#include "arguments.h"
#include "nematic.h"
#include "symmetric_tensor.h"
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace grainscope {

using Block = FieldSums::Block;
using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr auto intensive = Extent::intensive, whole = Extent::whole;

/** The sums of one cell. */
struct CellSums {
  const FieldSums &sums;
  int cell;
  double samples;
  FieldUnits units;

  double operator()(Block block, int k = 0) const { return sums.of(block, cell)[k]; }
  Map<const Vector3d> vector(Block block) const { return Map<const Vector3d>(sums.of(block, cell)); }
  double volume() const { return (*this)(FieldSums::volume); }
  /** Without anything below it is 0. */
  static double ratio(double above, double below) { return below > 0.0 ? above / below + 0.0 : 0.0; }
};

struct Words {
  const char *vector, *six, *nine;
};
const Words cartesian = {"x y z", "xx yy zz xy xz yz", "xx xy xz yx yy yz zx zy zz"};
const Words cylindrical = {"r t a", "rr tt aa rt ra ta", "rr rt ra tr tt ta ar at aa"};

double of_volume(const CellSums &s) { return s.volume(); }
double of_mass(const CellSums &s) { return s(FieldSums::mass); }
double of_grains(const CellSums &s) { return s(FieldSums::grains); }
double of_contacts(const CellSums &s) { return s(FieldSums::contacts, 0) + s(FieldSums::contacts, 1); }
double of_axes(const CellSums &s) { return s(FieldSums::axes, 6); }

double *write_vector(const CellSums &s, Block block, double over, double *to) {
  for (int k = 0; k < 3; k++) *to++ = CellSums::ratio(s(block, k), over);
  return to;
}

/** Stress of a whole force, tension positive. */
double *write_stress(const CellSums &s, Block block, double *to) {
  for (int k = 0; k < 9; k++) *to++ = -s.units.pressure * s(block, k) / s.volume() + 0.0;
  return to;
}

/** <p p> - 1/3. */
Matrix3d order_tensor(const CellSums &s) {
  const double n = s(FieldSums::axes, 6);
  if (!(n > 0.0)) return Matrix3d::Zero();
  return symmetric_tensor(s.sums.of(FieldSums::axes, s.cell)) / n - Matrix3d::Identity() / 3.0;
}

Vector3d director(const CellSums &s) {
  if (!(s(FieldSums::axes, 6) > 0.0)) return Vector3d::Zero();
  const Vector3d n = Eigen::SelfAdjointEigenSolver<Matrix3d>(order_tensor(s)).eigenvectors().col(2);
  int largest = 0;
  n.cwiseAbs().maxCoeff(&largest);
  return n[largest] < 0.0 ? Vector3d(-n) : n;
}

}

struct FieldQuantities::Quantity {
  const char *name;
  unsigned blocks;
  double (*below)(const CellSums &s);  // what it is per
  void (*declare)(OutputList &columns, const Words &words);
  double *(*write)(const CellSums &s, double *to);
};

const std::vector<FieldQuantities::Quantity> &FieldQuantities::all() {
  using F = FieldSums;
  using List = OutputList;
  // clang-format off
  static const std::vector<Quantity> quantities = {
      {"density", F::mass, of_volume,
       [](List &list, const Words &) {
         list.add({"rho", "mass/volume", intensive, "mass of grains over volume"});
       },
       [](const CellSums &s, double *to) {
         *to++ = s(F::mass) / s.volume();
         return to;
       }},
      {"phi", F::solid, of_volume,
       [](List &list, const Words &) {
         list.add({"phi", "-", intensive, "solid fraction"});
       },
       [](const CellSums &s, double *to) {
         *to++ = s(F::solid) / s.volume();
         return to;
       }},
      {"momentum", F::momentum, of_volume,
       [](List &list, const Words &words) {
         list.add_each(words.vector, {"p_*", "mass velocity/volume", intensive, "momentum density *"});
       },
       [](const CellSums &s, double *to) { return write_vector(s, F::momentum, s.volume(), to); }},
      {"velocity", F::mass | F::momentum, of_mass,
       [](List &list, const Words &words) {
         list.add_each(words.vector, {"v_*", "velocity", intensive, "velocity *, momentum over mass"});
       },
       [](const CellSums &s, double *to) { return write_vector(s, F::momentum, s(F::mass), to); }},
      {"spin", F::spin, of_grains,
       [](List &list, const Words &words) {
         list.add_each(words.vector, {"w_*", "1/time", intensive, "mean angular velocity *"});
       },
       [](const CellSums &s, double *to) { return write_vector(s, F::spin, s(F::grains), to); }},
      {"temperature", F::mass | F::momentum | F::centroid | F::motion, of_mass,
       [](List &list, const Words &words) {
         list.add_each(words.vector, {"T_*", "velocity^2", intensive, "granular temperature *"})
             .add({"T", "velocity^2", intensive, "granular temperature, mean of the axes"});
       },
       [](const CellSums &s, double *to) {
         double sum = 0.0;
         for (int k = 0; k < 3; k++) sum += *to++ = CellSums::ratio(s(F::motion, k), s(F::mass));
         *to++ = sum / s.units.dimension;
         return to;
       }},
      {"stress", F::force, of_volume,
       [](List &list, const Words &words) {
         list.add_each(words.nine, {"s_*", "pressure", intensive, "contact stress *, tension positive"});
       },
       [](const CellSums &s, double *to) { return write_stress(s, F::force, to); }},
      {"stress_normal", F::force | F::tangential, of_volume,
       [](List &list, const Words &words) {
         list.add_each(words.nine, {"sn_*", "pressure", intensive, "part of s_* from normal forces"});
       },
       [](const CellSums &s, double *to) {
         for (int k = 0; k < 9; k++)
           *to++ = -s.units.pressure * (s(F::force, k) - s(F::tangential, k)) / s.volume() + 0.0;
         return to;
       }},
      {"stress_tangential", F::tangential, of_volume,
       [](List &list, const Words &words) {
         list.add_each(words.nine, {"st_*", "pressure", intensive, "part of s_* from tangential forces"});
       },
       [](const CellSums &s, double *to) { return write_stress(s, F::tangential, to); }},
      {"stress_kinetic", F::mass | F::momentum | F::centroid | F::motion, of_volume,
       [](List &list, const Words &words) {
         list.add_each(words.six, {"sk_*", "pressure", intensive, "kinetic stress *, not in s_*"});
       },
       [](const CellSums &s, double *to) {
         for (int k = 0; k < 6; k++) *to++ = -s.units.kinetic * s(F::motion, k) / s.volume() + 0.0;
         return to;
       }},
      {"traction", F::traction, of_volume,
       [](List &list, const Words &words) {
         list.add_each(words.vector, {"t_*", "force/volume", intensive, "force * of walls on grains"});
       },
       [](const CellSums &s, double *to) { return write_vector(s, F::traction, s.volume(), to); }},
      {"contacts", F::contacts, of_volume,
       [](List &list, const Words &) {
         list.add({"N_c", "-", whole, "contacts between grains"}).add({"N_w", "-", whole, "contacts with walls"});
       },
       [](const CellSums &s, double *to) {
         for (int k = 0; k < 2; k++) *to++ = s(F::contacts, k) / s.samples;
         return to;
       }},
      {"coordination", F::ends, of_grains,
       [](List &list, const Words &) {
         list.add({"Z", "-", intensive, "contacts of the grains, per grain"});
       },
       [](const CellSums &s, double *to) {
         *to++ = CellSums::ratio(s(F::ends), s(F::grains));
         return to;
       }},
      {"fabric", F::contacts | F::fabric, of_contacts,
       [](List &list, const Words &words) {
         list.add_each(words.six, {"F_*", "-", intensive, "fabric *, <n n>"});
       },
       [](const CellSums &s, double *to) {
         const double n = of_contacts(s);
         for (int k = 0; k < 6; k++) *to++ = CellSums::ratio(s(F::fabric, k), n);
         return to;
       }},
      {"P_n", F::losses, of_volume,
       [](List &list, const Words &) {
         list.add({"P_n", "power/volume", intensive, "power lost by normal damping"});
       },
       [](const CellSums &s, double *to) {
         *to++ = s(F::losses, 0) / s.volume() + 0.0;
         return to;
       }},
      {"P_t", F::losses, of_volume,
       [](List &list, const Words &) {
         list.add({"P_t", "power/volume", intensive, "power lost by friction of sliding contacts"})
             .add({"P_t_damp", "power/volume", intensive, "power lost by tangential damping of the others"});
       },
       [](const CellSums &s, double *to) {
         for (int k = 1; k < 3; k++) *to++ = s(F::losses, k) / s.volume() + 0.0;
         return to;
       }},
      {"overlap", F::contacts | F::overlaps, of_contacts,
       [](List &list, const Words &) {
         list.add({"overlap", "distance", intensive, "mean overlap"});
       },
       [](const CellSums &s, double *to) {
         *to++ = CellSums::ratio(s(F::overlaps), of_contacts(s));
         return to;
       }},
      {"Q", F::axes, of_axes,
       [](List &list, const Words &words) {
         list.add_each(words.six, {"Q_*", "-", intensive, "order tensor *, <p p> - 1/3"});
       },
       [](const CellSums &s, double *to) { return write_components(order_tensor(s), to); }},
      {"S2", F::axes, of_axes,
       [](List &list, const Words &) {
         list.add({"S2", "-", intensive, "nematic order"});
       },
       [](const CellSums &s, double *to) {
         const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(order_tensor(s), Eigen::EigenvaluesOnly);
         *to++ = 1.5 * solver.eigenvalues()[2];
         return to;
       }},
      {"director", F::axes, of_axes,
       [](List &list, const Words &words) {
         list.add_each(words.vector, {"n_*", "-", intensive, "director *"});
       },
       [](const CellSums &s, double *to) {
         const Vector3d n = director(s);
         return std::copy_n(n.data(), 3, to);
       }},
  };
  // clang-format on
  return quantities;
}

std::vector<std::string> FieldQuantities::names(int dimension) {
  std::vector<std::string> names;
  for (const Quantity &one : all())
    if (dimension == 3 || !(one.blocks & FieldSums::axes)) names.push_back(one.name);
  return names;
}

FieldQuantities::FieldQuantities(const Arguments &errors, const std::vector<std::string> &names) {
  blocks_ = FieldSums::volume | FieldSums::grains | FieldSums::mass;
  std::string known = "all";
  for (const Quantity &one : all()) known += ", " + std::string(one.name);
  for (const std::string &name : names) {
    if (std::count(names.begin(), names.end(), name) > 1) errors.fail("'quantities' names '" + name + "' twice");
    const auto same = [&name](const Quantity &one) { return name == one.name; };
    const auto found = std::find_if(all().begin(), all().end(), same);
    if (found == all().end()) errors.fail("quantities", known, name);
  }
  for (const Quantity &one : all())
    if (std::find(names.begin(), names.end(), one.name) != names.end()) {
      chosen_.push_back(&one);
      blocks_ |= one.blocks;
    }
}

bool FieldQuantities::need_contacts() const {
  return blocks_ & (FieldSums::force | FieldSums::tangential | FieldSums::contacts | FieldSums::ends |
                    FieldSums::losses | FieldSums::traction);
}

OutputList FieldQuantities::columns(bool rings) const {
  const Words &words = rings ? cylindrical : cartesian;
  OutputList list;
  list.add_each(words.vector, {"*", "distance", intensive, "* of the middle of the cell"})
      .add({"V", "volume", intensive, "volume of the cell"})
      .add({"N", "-", whole, "grains"});
  for (const Quantity *one : chosen_) one->declare(list, words);
  return list;
}

double *FieldQuantities::write(const FieldSums &sums, int cell, double samples, const FieldUnits &units,
                               double *to) const {
  const CellSums s = {sums, cell, samples, units};
  *to++ = s.volume() / samples;
  *to++ = s(FieldSums::grains) / samples;
  for (const Quantity *one : chosen_) to = one->write(s, to);
  return to;
}

std::vector<double> FieldQuantities::below(const FieldSums &sums, int cell) const {
  const CellSums s = {sums, cell, 1.0, {}};
  std::vector<double> values(2, s.volume());  // V, N
  for (const Quantity *one : chosen_) {
    OutputList columns;
    one->declare(columns, cartesian);
    values.insert(values.end(), columns.size(), one->below(s));
  }
  return values;
}

}
