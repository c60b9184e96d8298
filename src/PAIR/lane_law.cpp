// SPDX-License-Identifier: GPL-2.0-or-later
#include "lane_law.h"
#include "atom.h"
#include "force.h"
#include "global_properties.h"
#include "properties.h"
#include "update.h"
#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>

namespace grainscope {

namespace {

const std::map<std::string, PairLaw::Normal> NORMALS = {{"hertz", PairLaw::Normal::hertz},
                                                        {"hooke", PairLaw::Normal::hooke},
                                                        {"hertz/stiffness", PairLaw::Normal::hertz_stiffness},
                                                        {"hooke/stiffness", PairLaw::Normal::hooke_stiffness}};
const std::map<std::string, PairLaw::Tangential> TANGENTIALS = {{"off", PairLaw::Tangential::off},
                                                                {"no_history", PairLaw::Tangential::no_history},
                                                                {"history", PairLaw::Tangential::history}};

}

/** False if a word is not known here, or requires more than a PairLaw has. */
bool LaneLaw::read(const std::string &models) {
  law_ = PairLaw();
  synchronized_ = false;
  std::istringstream words(models);
  std::string name, value;
  while (words >> name >> value) {
    const bool on = value == "on" || value == "yes", off = value == "off" || value == "no";
    if (name == "model") {
      if (!NORMALS.count(value)) return false;
      law_.normal = NORMALS.at(value);
    } else if (name == "tangential") {
      if (!TANGENTIALS.count(value)) return false;
      law_.tangential = TANGENTIALS.at(value);
    } else if (name == "surface") {
      if (value != "ellipsoid" && value != "default") return false;
    } else if (name == "curvatureLimitFactor") {
      law_.curvature_limit = std::atof(value.c_str());
    } else if (name == "gaussianCurvature" || name == "meanCurvature") {
      if (name == "meanCurvature" && on) return false;
    } else if (name == "tangential_damping") {
      law_.tangential_damping = on;
    } else if (name == "limitForce") {
      law_.limits_force = on;
    } else if (name == "ktToKnUser") {
      law_.two_sevenths = on;
    } else if (name == "absolute_damping") {
      law_.absolute_damping = on;
    } else if (!off) {
      return false;
    }
  }
  return true;
}

void LaneLaw::connect(const std::string &models, bool spring_in_place) {
  covers_ = read(models) && force->nktv2p == 1.0 && atom->rmass;
  if (law_.tangential == PairLaw::Tangential::history) covers_ = covers_ && spring_in_place;
  if (!covers_) return;
  PropertyRegistry &registry = force->registry;
  const char *who = "pair_style gran/insitu";
  const auto matrix = [&](const char *name, MatrixPropertyCreator create, double **&values) {
    registry.registerProperty(name, create);
    registry.connect(name, values, who);
  };
  switch (law_.normal) {
    case PairLaw::Normal::hertz:
      matrix("Yeff", &MODEL_PARAMS::createYeff, young_);
      matrix("Geff", &MODEL_PARAMS::createGeff, shear_);
      matrix("betaeff", &MODEL_PARAMS::createBetaEff, beta_);
      break;
    case PairLaw::Normal::hooke:
      matrix("Yeff", &MODEL_PARAMS::createYeff, young_);
      matrix("coeffRestLog", &MODEL_PARAMS::createCoeffRestLog, log_restitution_);
      registry.registerProperty("charVel", &MODEL_PARAMS::createCharacteristicVelocity);
      registry.connect("charVel", law_.characteristic_speed, who);
      break;
    default:
      matrix("k_n", &MODEL_PARAMS::createKn, stiffness_[0]);
      matrix("k_t", &MODEL_PARAMS::createKt, stiffness_[1]);
      if (law_.normal == PairLaw::Normal::hertz_stiffness) {
        matrix("gamma_n", &MODEL_PARAMS::createGamman, stiffness_[2]);
        matrix("gamma_t", &MODEL_PARAMS::createGammat, stiffness_[3]);
      } else if (law_.absolute_damping) {
        matrix("gamman_abs", &MODEL_PARAMS::createGammanAbs, stiffness_[2]);
        matrix("gammat_abs", &MODEL_PARAMS::createGammatAbs, stiffness_[3]);
      } else {
        matrix("gamman", &MODEL_PARAMS::createGamman, stiffness_[2]);
        matrix("gammat", &MODEL_PARAMS::createGammat, stiffness_[3]);
      }
  }
  if (law_.tangential != PairLaw::Tangential::off) matrix("coeffFrict", &MODEL_PARAMS::createCoeffFrict, friction_);
  law_.types = atom->get_properties()->max_type();  // of those in use: the host's matrices know no others
  law_.terms.resize(law_.types * law_.types);
}

PairLaw::Terms LaneLaw::terms_of(int i, int j) const {
  PairLaw::Terms t{};
  const double root_of_five_sixths = 0.91287092917527685576161630466800355658790782499663875;
  switch (law_.normal) {
    case PairLaw::Normal::hertz: {
      const double by[] = {2. * young_[i][j], 8. * shear_[i][j], 4. / 3. * young_[i][j],
                           -2. * root_of_five_sixths * beta_[i][j]};
      std::copy(by, by + 4, t.constant);
      break;
    }
    case PairLaw::Normal::hooke: {
      const double square = log_restitution_[i][j] * log_restitution_[i][j];
      const double by[] = {young_[i][j], square, square + M_PI * M_PI, 0.0};
      std::copy(by, by + 4, t.constant);
      break;
    }
    default:
      for (int k = 0; k < 4; k++) t.constant[k] = stiffness_[k][i][j];
  }
  t.friction = law_.tangential == PairLaw::Tangential::off ? 0.0 : friction_[i][j];
  return t;
}

void LaneLaw::refresh() {
  law_.dt = update->dt;
  for (int i = 0; i < law_.types; i++)
    for (int j = 0; j < law_.types; j++) law_.terms[i * law_.types + j] = terms_of(i + 1, j + 1);
}

}
