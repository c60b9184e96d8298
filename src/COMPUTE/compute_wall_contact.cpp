// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_wall_contact.h"
#include "arguments.h"
#include "chosen_walls.h"
#include "contact_law.h"
#include "contact_observer.h"
#include "contact_sums.h"
#include "fix_grain_record.h"
#include "grain_shape.h"
#include "requirements.h"
#include "wall_contact_sums.h"
#include "wall_reach.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include <array>
#include <cstdint>
#include <map>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using grainscope::Arguments;
using grainscope::ChosenWalls;
using grainscope::Contact;
using grainscope::Extent;
using grainscope::OutputList;
using grainscope::WallContactSums;

namespace {

const std::vector<std::string> keywords = {"walls", "about", "area", "losses", "impacts"};
const int most_walls = 52;  // one bit each in a double

struct Choices {
  Vector3d about = Vector3d::Zero();
  bool losses = true, impacts = false;
};

/** The numbers of one wall, or of all together. An array is never divided by the number of grains. */
OutputList numbers(const std::string &suffix, Extent sum, const Choices &chosen) {
  const auto intensive = Extent::intensive, whole = Extent::whole;
  OutputList list;
  list.add({"N" + suffix, "-", whole, "contacts"})
      .add({"N_sliding" + suffix, "-", whole, "sliding contacts"})
      .add_each("x y z", {"force_*" + suffix, "force", sum, "force on the wall, *"})
      .add_each("x y z", {"torque_*" + suffix, "force*distance", sum, "torque on the wall, *"})
      .add({"F_n" + suffix, "force", sum, "sum of normal forces, > 0 pushes apart"})
      .add({"F_t" + suffix, "force", sum, "sum of the magnitudes of tangential forces"})
      .add({"area" + suffix, "distance^2", whole,
            "area of the wall, in two dimensions its length, 0 where it is not known"})
      .add({"p" + suffix, "pressure", intensive, "normal traction, F_n over the area"})
      .add({"tau" + suffix, "pressure", intensive, "shear traction, F_t over the area"})
      .add({"power" + suffix, "energy/time", sum, "power that the wall gives to the grains"});
  if (chosen.losses)
    list.add({"P_n" + suffix, "energy/time", sum, "power lost by normal damping"})
        .add({"P_t" + suffix, "energy/time", sum, "power lost by friction of sliding contacts"})
        .add({"P_t_damp" + suffix, "energy/time", sum, "power lost by tangential damping of contacts that stick"});
  if (chosen.impacts)
    list.add({"N_impacts" + suffix, "-", whole, "grains that began to touch it"})
        .add({"impact_velocity" + suffix, "velocity", intensive, "mean normal velocity of impacts, toward the wall"})
        .add({"impact_energy" + suffix, "energy", whole, "sum of m/2 times that velocity squared"});
  return list;
}

/** Grains that begin to touch a wall. What each grain touched in the last evaluation, one bit per wall, is in the
 *  record's numbers of the grain; those that all ranks share are whether there was one, and the sums of each wall. */
class Impacts {
 public:
  enum { watched, sums };
  enum Of { number, velocity, energy, width };

  explicit Impacts(int walls) : walls_(walls) {}
  int shared_numbers() const { return sums + walls_ * width; }

  void begin(int grains) {
    touched_.assign(grains, 0);
    fresh_.clear();
  }
  /** `row` of the wall. Of several triangles that a grain meets at once, the one that it meets fastest counts. */
  void add(const Contact &c, int row, FixGrainRecord &record) {
    const std::uint64_t bit = std::uint64_t(1) << row;
    touched_[c.i] |= bit;
    if (static_cast<std::uint64_t>(record.of(c.i)[0]) & bit) return;
    const double approach = -c.motion->normal_velocity;
    const auto made = fresh_.insert({{c.i, row}, approach});
    if (!made.second) made.first->second = std::max(made.first->second, approach);
  }
  /** Collective. Without `counts` it only remembers. */
  void end(FixGrainRecord &record, bool counts, const Atom &atom, MPI_Comm world) {
    std::vector<double> step(static_cast<std::size_t>(walls_) * width, 0.0);
    for (const auto &one : fresh_) {
      const int i = one.first.first;
      const double speed = one.second, mass = grainscope::mass_of(atom, i);
      double *const at = &step[one.first.second * width];
      at[number] += 1.0;
      at[velocity] += speed;
      at[energy] += 0.5 * mass * speed * speed;
    }
    for (std::size_t i = 0; i < touched_.size(); i++) record.of(i)[0] = static_cast<double>(touched_[i]);
    std::vector<double> &shared = record.shared();
    MPI_Allreduce(MPI_IN_PLACE, step.data(), static_cast<int>(step.size()), MPI_DOUBLE, MPI_SUM, world);
    for (std::size_t k = 0; counts && shared[watched] == 1.0 && k < step.size(); k++) shared[sums + k] += step[k];
    shared[watched] = 1.0;
  }
  double memory() const { return touched_.capacity() * sizeof(std::uint64_t); }

 private:
  int walls_;
  std::vector<std::uint64_t> touched_;           // of each grain
  std::map<std::pair<int, int>, double> fresh_;  // grain and wall: the velocity of its approach
};

}

struct ComputeWallContact::Impl {
  Choices chosen;
  std::unique_ptr<ChosenWalls> walls;
  std::vector<double> given_areas;  // 0: not given
  std::vector<int> row_of_wall;
  std::array<bool, 3> fixed;  // faces of the box do not follow the grains
  grainscope::ContactSums<WallContactSums> sums;
  std::unique_ptr<Impacts> impacts;
  FixGrainRecord *record = nullptr;
  bool asked = false, warned = false;

  double area_of(int row, const grainscope::BoxState &box, MPI_Comm world, std::string &why) const {
    if (given_areas[row] > 0.0) return given_areas[row];
    const grainscope::Wall &wall = walls->walls()[row];
    if (!wall.mesh) return grainscope::primitive_area(wall.primitive, box, fixed, why);
    if (box.dimension == 2) {
      why = "a mesh has no length in two dimensions";
      return 0.0;
    }
    double area = grainscope::mesh_area(wall);
    MPI_Allreduce(MPI_IN_PLACE, &area, 1, MPI_DOUBLE, MPI_SUM, world);
    return area;
  }
  void put(double *to, const WallContactSums::Row &s, double area, const double *impact) const {
    using S = WallContactSums;
    to = std::copy_n(s.begin(), S::power, to);
    *to++ = area;
    *to++ = area > 0.0 ? s[S::normal] / area : 0.0;
    *to++ = area > 0.0 ? s[S::shear] / area : 0.0;
    *to++ = s[S::power];
    if (chosen.losses) to = std::copy_n(s.begin() + S::normal_damping, 3, to);
    if (!chosen.impacts) return;
    const double n = impact[Impacts::number];
    *to++ = n;
    *to++ = n > 0.0 ? impact[Impacts::velocity] / n : 0.0;
    *to++ = impact[Impacts::energy];
  }
};

ComputeWallContact::ComputeWallContact(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg, 0, grainscope::Walls::only), impl_(new Impl) {
  Arguments arguments(lmp, name_, iarg, narg, arg);
  Choices &chosen = impl_->chosen;
  std::vector<std::string> named, areas;
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(keywords);
    if (keyword == "walls") named = arguments.words_before(keywords, "names of walls");
    else if (keyword == "area") areas = arguments.words_before(keywords, "the name of a wall and its area");
    else if (keyword == "losses") chosen.losses = arguments.yes_or_no(keyword);
    else if (keyword == "impacts") chosen.impacts = arguments.yes_or_no(keyword);
    else
      for (int k = 0; k < 3; k++)
        chosen.about[k] = arguments.number(keyword, "three coordinates", [](double) { return true; });
  }
  impl_->walls.reset(new ChosenWalls(lmp, arguments, ChosenWalls::Kind::any, named));
  const int rows = impl_->walls->size();
  impl_->given_areas.assign(rows, 0.0);
  for (std::size_t k = 0; k < areas.size(); k += 2) {
    double &area = impl_->given_areas[impl_->walls->index_of(areas[k], "area", arguments)];
    if (area > 0.0) arguments.fail("'area' names '" + areas[k] + "' twice");
    const std::string value = k + 1 < areas.size() ? areas[k + 1] : "";
    if (!Arguments::is_number(value, area) || area <= 0.0) arguments.fail("area " + areas[k], "an area > 0", value);
  }
  impl_->sums = grainscope::ContactSums<WallContactSums>(WallContactSums(chosen.about));
  sums_over(impl_->sums);
  grainscope::Outputs outputs;
  outputs.vector = numbers("", Extent::extensive, chosen);
  outputs.scalar = {outputs.vector[WallContactSums::normal]};
  std::string row = "wall";
  for (int k = 0; k < rows; k++) row += (k ? ", " : ": ") + std::to_string(k + 1) + " " + impl_->walls->names()[k];
  outputs.set_array(rows, row, numbers("_w", Extent::whole, chosen));
  declare(this, outputs);
  if (!chosen.impacts) return;
  if (rows > most_walls)
    arguments.fail("'impacts yes' takes at most " + std::to_string(most_walls) + " walls, got " + std::to_string(rows));
  grainscope::require_box(lmp, arguments);
  impl_->impacts.reset(new Impacts(rows));
  std::string meaning = name_ + " " + group->names[igroup];
  for (const std::string &name : impl_->walls->names()) meaning += " " + name;
  FixGrainRecord::make(lmp, id, igroup, 1, impl_->impacts->shared_numbers(), meaning);
}

ComputeWallContact::~ComputeWallContact() {
  if (impl_->impacts) FixGrainRecord::forget(lmp, id);
}

void ComputeWallContact::init() {
  ContactCompute::init();
  impl_->row_of_wall = impl_->walls->find(Arguments(lmp, name_ + " " + id));
  impl_->sums.mine().set_rows(impl_->row_of_wall, impl_->walls->size());
  if (impl_->chosen.losses) require_losses();
  if (impl_->impacts) impl_->record = FixGrainRecord::find(lmp, id);
  const int last_that_stands = 1;  // of the host's numbers for p f s m
  for (int k = 0; k < 3; k++)
    impl_->fixed[k] = domain->boundary[k][0] <= last_that_stands && domain->boundary[k][1] <= last_that_stands;
  warn_of_unknown_areas();
}

void ComputeWallContact::require_losses() const {
  for (const grainscope::Wall &wall : impl_->walls->walls()) {
    const std::string why = wall.law ? wall.law->why_no_losses() : "";
    if (!why.empty())
      Arguments(lmp, name_).fail("wall '" + wall.name + "': " + why + ": change its models, or use 'losses no'");
  }
}

/** Once: a 0 that means unknown must not be read as a number. */
void ComputeWallContact::warn_of_unknown_areas() {
  if (impl_->warned) return;
  for (int row = 0; row < impl_->walls->size(); row++) {
    const grainscope::Wall &wall = impl_->walls->walls()[row];
    std::string why;
    if (!wall.mesh || domain->dimension == 2) impl_->area_of(row, grainscope::BoxState(lmp), world, why);
    if (why.empty()) warn_of_walls_across(wall, impl_->given_areas[row]);
    if (why.empty()) continue;
    impl_->warned = true;
    if (comm->me == 0)
      error->warning(FLERR, (name_ + " " + id + ": the area of wall '" + wall.name + "' is not known (" + why +
                             "): area and tractions are 0. Give it by 'area " + wall.name + " A'")
                                .c_str());
  }
}

/** Grains may press on a part of a wall that reaches across the box. Collective. */
void ComputeWallContact::warn_of_walls_across(const grainscope::Wall &wall, double given) {
  const std::string bounds =
      wall.mesh || given > 0.0 ? "" : grainscope::walls_that_bound(wall, grainscope::BoxState(lmp), lmp);
  if (bounds.empty()) return;
  impl_->warned = true;
  if (comm->me == 0)
    error->warning(FLERR, (name_ + " " + id + ": the area of wall '" + wall.name +
                           "' is all of it that lies in the box, but it meets inside the box: " + bounds +
                           ". If grains touch a part of it only, p and tau are too small: give that part by 'area " +
                           wall.name + " A'")
                              .c_str());
}

bool ComputeWallContact::wants_contacts() {
  impl_->asked = ContactCompute::wants_contacts();
  return impl_->asked || impl_->impacts;
}

void ComputeWallContact::begin_contacts() {
  if (impl_->asked) ContactCompute::begin_contacts();
  if (impl_->impacts) impl_->impacts->begin(observer_->local_grains());
}

void ComputeWallContact::add_contacts(grainscope::ContactSpan contacts) {
  if (impl_->asked) ContactCompute::add_contacts(contacts);
  if (!impl_->impacts) return;
  grainscope::for_each_contact(contacts, selection(), [this](const Contact &c) {
    const int row = impl_->row_of_wall[c.wall().wall];
    if (row >= 0) impl_->impacts->add(c, row, *impl_->record);
  });
}

/** The first evaluation of a run repeats positions that were counted before. */
void ComputeWallContact::end_contacts() {
  if (impl_->impacts) impl_->impacts->end(*impl_->record, observer_->springs_move(), *atom, world);
}

void ComputeWallContact::answer() {
  const WallContactSums &all = impl_->sums.total(*this);
  WallContactSums::Row sum{};
  std::array<double, Impacts::width> impacts{};
  double area = 0.0;
  bool known = true;
  for (int row = 0; row < all.rows(); row++) {
    const WallContactSums::Row one = all.of(row);
    std::string why;
    const double its_area = impl_->area_of(row, observer_->box(), world, why);
    const double *const impact =
        impl_->impacts ? &impl_->record->shared()[Impacts::sums + row * Impacts::width] : nullptr;
    impl_->put(array[row], one, its_area, impact);
    for (std::size_t k = 0; k < sum.size(); k++) sum[k] += one[k];
    for (std::size_t k = 0; impact && k < impacts.size(); k++) impacts[k] += impact[k];
    area += its_area;
    known = known && its_area > 0.0;
  }
  impl_->put(vector, sum, known ? area : 0.0, impacts.data());
  scalar = sum[WallContactSums::normal];
}

double ComputeWallContact::memory_usage() { return array_bytes() + (impl_->impacts ? impl_->impacts->memory() : 0.0); }
