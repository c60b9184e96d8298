// SPDX-License-Identifier: GPL-2.0-or-later
/** The outputs of fix press/strain. */
#include "press_strain_impl.h"

using namespace LAMMPS_NS;
using grainscope::BoxMotion;
using grainscope::mean_loop;
using grainscope::number_of_box_modes;
using How = BoxMotion::How;

namespace {

/** Order of tilts in the output: xy, xz, yz. */
constexpr int planes[3] = {5, 4, 3};

}

const std::vector<FixPressStrain::Impl::Element> &FixPressStrain::Impl::elements() {
  using F = FixPressStrain;
  constexpr auto intensive = grainscope::Extent::intensive;
  static const std::vector<Element> all = [] {
    std::vector<Element> list = {
        {{"strain", "-", intensive, "accumulated strain that inputs count, sum of |rate| dt"},
         [](F &f) { return f.impl_->strain; }},
        {{"target", "pressure", intensive, "pressure to hold, P_t"}, [](F &f) { return f.impl_->main_target(); }},
        {{"P", "pressure", intensive, "pressure of this step's contacts"},
         [](F &f) { return f.impl_->main_of(f.pressures_now()); }},
        {{"L", "distance", intensive, "box length along the axis"},
         [](F &f) { return f.impl_->box.length(f.impl_->shown_edge()); }},
        {{"L_rate", "velocity", intensive, "dL/dt"}, [](F &f) { return f.impl_->rates()[f.impl_->shown_edge()]; }},
        {{"inputs", "-", intensive, "control inputs so far"}, [](F &f) { return f.impl_->inputs; }},
        {{"clipped", "-", intensive, "inputs clipped so far"}, [](F &f) { return f.impl_->clipped; }},
        {{"error", "-", intensive, "P_mean/P_t - 1, 0 when P_t is 0"}, [](F &f) { return f.relative_error(); }}};
    add_edges(list);
    add_planes(list);
    list.push_back(
        {{"pressure", "pressure", intensive, "mean of the pressures along the axes, of this step's contacts"},
         [](F &f) { return f.impl_->mean_of(f.pressures_now()); }});
    list.push_back({{"target_mean", "pressure", intensive, "target of the mean pressure, 0 if there is none"},
                    [](F &f) { return f.impl_->settings.has_mean ? f.impl_->settings.mean.value : 0.0; }});
    list.push_back({{"clipped_mean", "-", intensive, "inputs of the mean pressure clipped so far"},
                    [](F &f) { return f.impl_->clipped_of[mean_loop]; }});
    return list;
  }();
  return all;
}

void FixPressStrain::Impl::add_edges(std::vector<Element> &all) {
  using F = FixPressStrain;
  constexpr auto intensive = grainscope::Extent::intensive;
  for (int k = 0; k < 3; k++) {
    const std::string axis(1, "xyz"[k]);
    all.push_back({{"P_" + axis, "pressure", intensive, "pressure along " + axis + " of this step's contacts"},
                   [k](F &f) { return f.pressures_now()[k]; }});
    all.push_back({{"target_" + axis, "pressure", intensive, "pressure to hold along " + axis + ", 0 if there is none"},
                   [k](F &f) { return f.impl_->target_of(k); }});
    all.push_back({{"L_" + axis, "distance", intensive, "box length along " + axis},
                   [k](F &f) { return f.impl_->box.length(k); }});
    all.push_back({{"rate_" + axis, "1/time", intensive, "(dL/dt)/L along " + axis},
                   [k](F &f) { return f.impl_->true_rate(k); }});
    all.push_back({{"strain_" + axis, "-", intensive, "logarithmic strain along " + axis + ", ln(L/L at the start)"},
                   [k](F &f) { return f.impl_->strains[k]; }});
    all.push_back({{"clipped_" + axis, "-", intensive, "inputs of " + axis + " clipped so far"},
                   [k](F &f) { return f.impl_->clipped_of[k]; }});
  }
}

void FixPressStrain::Impl::add_planes(std::vector<Element> &all) {
  using F = FixPressStrain;
  constexpr auto intensive = grainscope::Extent::intensive;
  for (int k : planes) {
    const std::string plane = grainscope::name_of_box_mode(k);
    all.push_back({{"s_" + plane, "pressure", intensive, "shear stress " + plane + " of this step's contacts"},
                   [k](F &f) { return -f.pressures_now()[k]; }});
    all.push_back(
        {{"target_" + plane, "pressure", intensive, "shear stress to hold in " + plane + ", 0 if there is none"},
         [k](F &f) { return f.impl_->target_of(k); }});
    all.push_back({{"rate_" + plane, "1/time", intensive, "shear rate in " + plane},
                   [k](F &f) { return f.impl_->true_rate(k); }});
    all.push_back({{"strain_" + plane, "-", intensive, "shear strain in " + plane + ", sum of rate dt"},
                   [k](F &f) { return f.impl_->strains[k]; }});
    all.push_back({{"clipped_" + plane, "-", intensive, "inputs of the shear in " + plane + " clipped so far"},
                   [k](F &f) { return f.impl_->clipped_of[k]; }});
  }
}

grainscope::Outputs FixPressStrain::Impl::declared() {
  grainscope::Outputs outputs;
  outputs.scalar = {
      {"P_mean", "pressure", grainscope::Extent::intensive, "pressure averaged over the last completed interval"}};
  for (const Element &one : elements()) outputs.vector.add(one.output);
  return outputs;
}

double FixPressStrain::Impl::mean_of(const std::array<double, number_of_box_modes> &of) const {
  return (of[0] + of[1] + (dimension == 3 ? of[2] : 0.0)) / dimension;
}

/** The first edge with a target of its own, or else the mean. */
double FixPressStrain::Impl::main_of(const std::array<double, number_of_box_modes> &of) const {
  const int edge = settings.main_edge();
  return edge >= 0 && settings.motions[edge].how == How::target ? of[edge] : mean_of(of);
}

double FixPressStrain::Impl::main_target() const {
  const int edge = settings.main_edge();
  return settings.has_mean ? settings.mean.value : edge >= 0 ? target_of(edge) : 0.0;
}

/** The edge whose length the first elements give: the controlled edge, or else the first that moves. */
int FixPressStrain::Impl::shown_edge() const {
  if (settings.main_edge() >= 0) return settings.main_edge();
  for (int k = 0; k < 3; k++)
    if (settings.motions[k].moves()) return k;
  return 0;
}
