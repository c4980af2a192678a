// SPDX-License-Identifier: MIT
#include "survey.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/operating_system.hpp>
#include <voussoir/io/stereonet_picture.hpp>
#include <voussoir/rockmass/orientation_file.hpp>
#include <voussoir/rockmass/orientation_sets.hpp>

#include "input_document.hpp"
#include "regular_file.hpp"

namespace voussoir::program {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr const char* key = "joints.orientations";

std::string degrees(double angle, int digits = 3) {
  return significant_text(angle / degree, digits) + " deg";
}

std::string names_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// The set of the survey that a joint set means: by its name, or "set 2" by the number 2.
std::optional<std::size_t> set_named(const SurveyInput& survey, const std::string& name) {
  for (std::size_t k = 0; k < survey.fits.size(); ++k) {
    const std::string own = lower_case(survey.fits[k].name);
    if (lower_case(name) == own || lower_case(name) == "set " + own) return k;
  }
  return std::nullopt;
}

/// What a joint set takes from the survey; nothing where it cannot, which is noted.
void take(Section& file, Input& input, std::size_t index) {
  JointSetInput& set = input.joint_sets[index];
  const SurveyInput& survey = *input.survey;
  const std::string place = "joint_set[" + std::to_string(index) + "]";
  auto at = set_named(survey, set.name);
  if (!at && survey.has_one_set) at = 0;
  if (!at)
    return file.complain(
        place, "has no dip, and " + survey.name + " no set by its name, \"" + set.name + "\"",
        "dip and dip_direction, or a key name: " + names_of(survey.set_names));
  const FittedSet& fit = survey.fits[*at];
  set.plane = fit.mean;
  set.is_azimuth = true;
  input.set_files[index].surveyed = static_cast<int>(*at);
  if (set.fisher || set.sd > 0) return;
  // Planes all alike have no K, and a set no scatter.
  if (!fit.concentration) {
    if (fit.count < 3)
      file.complain(place,
                    "has no K, and " + std::to_string(fit.count) + " planes in " + survey.name +
                        " tell of none",
                    "K = 30, or sd, besides; or three planes or more");
    return;
  }
  if (*fit.concentration < least_concentration)
    return file.complain(place,
                         "is no set in " + survey.name +
                             ": K = " + significant_text(*fit.concentration, 2) +
                             " is as good as no direction",
                         "sets of planes that are alike, K of 5 or more; or a key K besides");
  set.fisher = std::min(*fit.concentration, 1e6);
}

std::string survey_text(const FittedSet& fit) {
  std::string text = fit.name + ": " + std::to_string(fit.count) +
                     (fit.count == 1 ? " plane" : " planes") + ", mean dip " +
                     degrees(fit.mean.dip) + " towards " + degrees(fit.mean.dip_direction);
  if (fit.concentration) text += ", K " + significant_text(*fit.concentration, 3);
  if (fit.cone_95) text += ", the mean known to " + degrees(*fit.cone_95, 2) + " (95 %)";
  if (fit.count > 1) text += ", the farthest plane " + degrees(fit.largest_angle, 2) + " from it";
  return text;
}

}  // namespace

void read_survey(Section& file, Input& input) {
  if (!input.survey || file.faulty("joints") || file.faulty("joint_set")) return;
  SurveyInput& survey = *input.survey;
  survey.name = utf8_text(survey.file);
  const auto refuse = [&](const std::string& why) {
    file.complain(key, why,
                  "the name of a table of dips and dip directions, relative to the input file");
  };
  std::ifstream in;
  if (const std::string fault = open_regular(survey.file, in); !fault.empty()) return refuse(fault);
  try {
    OrientationFileLimits limits;
    limits.strike_is_right_handed = survey.strike_is_right_handed;
    OrientationFile read = read_orientations(in, survey.name, limits);
    for (SurveyedPlane& surveyed : read.planes)
      surveyed.plane =
          upright({surveyed.plane.dip, surveyed.plane.dip_direction + survey.declination});
    survey.planes = std::move(read.planes);
    survey.set_names = std::move(read.set_names);
    survey.layout = std::move(read.layout);
    survey.notes = std::move(read.notes);
    survey.has_one_set = survey.set_names.empty();
    survey.fits = fitted_sets(survey.planes, survey.set_names);
  } catch (const InvalidInput& fault) {
    return refuse(std::string("cannot be used: ") + fault.what());
  }
  int wanting = 0;
  for (const JointSetFile& set : input.set_files) wanting += set.wants_survey;
  if (survey.has_one_set && wanting > 1)
    return file.complain(key, "names no sets, and more than one [[joint_set]] has no dip",
                         "a column set in the file, or dip and dip_direction of all but one");
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k)
    if (input.set_files[k].wants_survey) take(file, input, k);
  for (std::size_t k = 0; k < survey.fits.size(); ++k)
    if (std::none_of(input.set_files.begin(), input.set_files.end(),
                     [&](const JointSetFile& set) { return set.surveyed == static_cast<int>(k); }))
      survey.left_out.push_back(survey.fits[k].name);
}

std::string survey_lines(const Input& input) {
  if (!input.survey) return "";
  const SurveyInput& survey = *input.survey;
  std::string out = "survey   " + survey.name + ": " + std::to_string(survey.planes.size()) +
                    " planes, " + survey.layout;
  for (const std::string& note : survey.notes) out += "; " + note;
  out += "\n";
  for (const FittedSet& fit : survey.fits) out += "survey   " + survey_text(fit) + "\n";
  return out;
}

std::string left_out_text(const SurveyInput& survey) {
  return "the rock has no joints of " + names_of(survey.left_out) + " of " + survey.name +
         ": no [[joint_set]] has that name";
}

nlohmann::json survey_json(const Input& input) {
  nlohmann::json sets = nlohmann::json::array();
  for (const FittedSet& fit : input.survey->fits) {
    nlohmann::json one{{"set", fit.name},
                       {"planes", fit.count},
                       {"weight", fit.weight},
                       {"mean_dip_deg", fit.mean.dip / degree},
                       {"mean_dip_direction_deg", fit.mean.dip_direction / degree},
                       {"K", nullptr},
                       {"cone_95_deg", nullptr},
                       {"largest_angle_deg", fit.largest_angle / degree}};
    if (fit.concentration) one["K"] = *fit.concentration;
    if (fit.cone_95) one["cone_95_deg"] = *fit.cone_95 / degree;
    sets.push_back(std::move(one));
  }
  return {{"planes", input.survey->planes.size()},
          {"layout", input.survey->layout},
          {"notes", input.survey->notes},
          {"sets", std::move(sets)}};
}

std::string stereonet_svg(const Input& input) {
  const SurveyInput& survey = *input.survey;
  StereonetPicture picture;
  picture.header.title = input.title.empty() ? "Joints as surveyed" : input.title;
  picture.planes = survey.planes;
  picture.sets = survey.fits;
  if (input.tunnel.trend)
    picture.tunnel = LineOrientation{*input.tunnel.trend, input.tunnel.plunge};
  return draw_stereonet_picture(picture);
}

}  // namespace voussoir::program
