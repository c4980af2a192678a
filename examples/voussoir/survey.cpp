// SPDX-License-Identifier: MIT
#include "survey.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/mass_picture.hpp>
#include <voussoir/io/operating_system.hpp>
#include <voussoir/io/stereonet_picture.hpp>
#include <voussoir/rockmass/orientation.hpp>
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

/// Where poles gather, for someone whose survey tells of no sets: "34/204 (41 planes)". Densest
/// places first, each with the planes about it, which are no part of the next.
std::string gatherings(std::span<const SurveyedPlane> planes) {
  constexpr std::size_t most = 5, looked_at = 1000;
  constexpr double sharpness = 29;  // of the density, as in the stereonet
  const double cosine = std::cos(30 * degree);
  std::vector<Vec3> normals;
  const std::size_t stride = 1 + planes.size() / looked_at;
  for (std::size_t k = 0; k < planes.size(); k += stride)
    normals.push_back(upward_normal(planes[k].plane));
  const std::size_t least = std::max<std::size_t>(3, normals.size() / 12);
  std::string text;
  for (std::size_t found = 0; found < most && normals.size() >= least; ++found) {
    Vec3 middle = normals[0];
    double densest = 0;
    for (const Vec3& at : normals) {
      double density = 0;
      for (const Vec3& other : normals)
        density += std::exp(sharpness * (std::abs(at.dot(other)) - 1));
      if (density > densest) densest = density, middle = at;
    }
    const auto others = std::partition(normals.begin(), normals.end(), [&](const Vec3& normal) {
      return std::abs(normal.dot(middle)) >= cosine;
    });
    const auto count = static_cast<std::size_t>(others - normals.begin());
    if (count < least) break;
    text += (text.empty() ? "" : ", ") +
            orientation_text(mean_orientation(std::span(normals.data(), count))) + " (" +
            std::to_string(count * stride) + " planes)";
    normals.erase(normals.begin(), others);
  }
  return text;
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
  std::ifstream in;
  if (const std::string fault = open_regular(survey.file, in); !fault.empty())
    return file.complain(
        key, fault, "the name of a table of dips and dip directions, relative to the input file");
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
  } catch (const InvalidInput& fault) {
    const std::string why = fault.what();
    const bool lacks_rule = why.find("strike without rule") != std::string::npos;
    return file.complain(key, "cannot be used: " + why,
                         std::string("a table as under \"Orientations\" in docs/input.md") +
                             (lacks_rule ? "; joints.strike = \"right-hand\" where every dip is to "
                                           "the right of its strike"
                                         : ""));
  }
  int wanting = 0;
  for (const JointSetFile& set : input.set_files) wanting += set.wants_survey;
  const auto refuse_as_no_sets = [&](const std::string& why) {
    std::string said = why;
    for (const std::string& note : survey.notes)
      if (note.starts_with("columns that are not read")) said += "; " + note;
    const std::string found = gatherings(survey.planes);
    file.complain(key, said,
                  "a column set in the file, with the name of a [[joint_set]] for each plane; or "
                  "dip, dip_direction and K in every [[joint_set]]" +
                      (found.empty() ? std::string() : ": the poles gather about " + found));
  };
  if (survey.has_one_set && wanting > 1)
    return refuse_as_no_sets("names no sets, and more than one [[joint_set]] has no dip");
  try {
    survey.fits = fitted_sets(survey.planes, survey.set_names);
  } catch (const InvalidInput& fault) {
    if (!survey.has_one_set || wanting > 0)
      return refuse_as_no_sets(std::string("cannot be used: ") + fault.what());
    survey.notes.emplace_back(
        "no set column, and the planes are no one set: drawn, no mean and K fitted to them");
  }
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k)
    if (input.set_files[k].wants_survey) take(file, input, k);
  // Planes without a set column stand beside sets that have their own dips: nothing is left out.
  for (std::size_t k = 0; k < survey.fits.size() && !(survey.has_one_set && wanting == 0); ++k)
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
