// SPDX-License-Identifier: MIT
// `voussoir run`, `check`, `blocks`, `grc`, `pullout`, `safety`, `init`: one input file, one
// tunnel.
#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/io/operating_system.hpp>

#include "analysis.hpp"
#include "blocks_analysis.hpp"
#include "blocks_outputs.hpp"
#include "check.hpp"
#include "ground_reaction.hpp"
#include "lining_strength.hpp"
#include "outputs.hpp"
#include "pullout.hpp"
#include "report_sections.hpp"
#include "rock_blocks.hpp"
#include "run_folder.hpp"
#include "safety.hpp"
#include "stage_pictures.hpp"
#include "survey.hpp"
#include "templates.hpp"
#include "verbs.hpp"

namespace voussoir::program {

namespace {

const char* const smaller_model =
    "a smaller domain (model.width, model.below_invert, tunnel.cover), fewer joints or a larger "
    "blocks.min_inscribed_radius";

/// What `run` and `diagram` report of themselves.
void now_doing(const std::string& what, const std::string& otherwise) {
  work.doing = what == "blocks" ? "cutting the rock into blocks" : otherwise;
}

/// On screen: words for a person or, asked for, what a program reads.
void say(const Options& options, const std::string& words, const std::string& json) {
  if (options.json)
    std::cout << json;
  else if (!options.quiet)
    std::cout << words;
}

/// One for every verdict, so that a script reads it as a person does.
/// @param has_lost  blocks or lining have come off
ExitStatus status_of(voussoir::Verdict verdict, bool has_lost) {
  switch (verdict) {
    case voussoir::Verdict::undecided:
      return not_decided;
    case voussoir::Verdict::collapse:
      return collapsed;
    case voussoir::Verdict::stable:
      return has_lost ? stands_after_rockfall : finished;
  }
  return not_decided;
}

/// What a run writes, and its report of it.
class ReportedFiles {
 public:
  ReportedFiles(RunFolder& outputs, std::string id) : outputs_(&outputs), id_(std::move(id)) {}
  void add(const std::string& name, const std::string& text) {
    outputs_->add(name, text, id_);
    files_.add(name, with_run_id(name, text, id_));
  }
  /// Adds the report of what was added. @return  run.json as it is written
  std::string report() {
    outputs_->add("report.html", report_page(files_), id_);
    return files_.text("run.json");
  }

 private:
  RunFolder* outputs_;
  std::string id_;
  ReportFiles files_;
};

/// Blocks that are laid.
int run_blocks_verb(const Options& options, const Input& input) {
  RunFolder outputs(options.folder);
  ProgressLine line(options.quiet);
  work.remedy = "fewer blocks";
  const BlocksRun run = run_blocks(input, [&](const std::string& what, double fraction) {
    work.doing = "computing the stage " + what;
    return line.show(what, fraction);
  });
  line.clear();
  if (stop_asked != 0) return say_interrupted();
  work.doing = "writing the results";
  ReportedFiles files(outputs, RunId("blocks").add(input).text());
  files.add("run.json", blocks_run_json(input, run));
  files.add("blocks.csv", blocks_csv(input, run));
  files.add("contacts.csv", contacts_csv(input, run));
  files.add("blocks.svg", laid_blocks_svg(input, run));
  const std::string json = files.report();
  say(options, blocks_summary(input, run), json);
  publish(outputs, options, "run.json, blocks.csv, contacts.csv, blocks.svg, report.html");
  return status_of(run.last().verdict, !run.last().fallen.empty());
}

/// A tunnel in 2-D or 3-D.
/// @param compute  the run, by what is told of its progress and takes the end of every stage
template <class Compute>
int run_tunnel_verb(const Options& options, const Input& input, Compute&& compute) {
  RunFolder outputs(options.folder);
  outputs.expect_folder(HistoryFiles::folder);
  const std::string id = RunId("tunnel").add(input).text();
  HistoryFiles history(input,
                       [&](const NamedDocument& file) { outputs.add(file.name, file.text, id); });
  StagePictures pictures(input);
  ProgressLine line(options.quiet);
  work.remedy = smaller_model;
  const auto run = compute(
      [&](const std::string& what, double fraction) {
        now_doing(what, "computing the stage " + what);
        return line.show(what, fraction);
      },
      history, pictures);
  line.clear();
  if (stop_asked != 0) return say_interrupted();
  work.doing = "writing the results";
  // Only some runs write these.
  for (const char* const name : {"blocks.vtu", "joints.vtu", "bolts.vtu", "lining.vtu",
                                 "tunnel.vtm", "lining_strength.svg", HistoryFiles::collection})
    outputs.replace(name);
  outputs.replace_all_in(HistoryFiles::folder);
  std::string names = "run.json, bolts.csv, lining.csv, blocks.svg";
  ReportedFiles files(outputs, id);
  files.add("run.json", run_json(input, run));
  files.add("bolts.csv", bolts_csv(input, run));
  files.add("lining.csv", lining_csv(input, run));
  files.add("blocks.svg", blocks_svg(input, run));
  for (const NamedDocument& picture : pictures.finish()) files.add(picture.name, picture.text);
  if (const LiningStrength strength = lining_strength_of(input, run); !strength.nodes.empty()) {
    files.add("lining_strength.svg", lining_strength_svg(input, strength));
    names += ", lining_strength.svg";
  }
  if (input.survey) {
    files.add("stereonet.svg", stereonet_svg(input));
    names += ", stereonet.svg";
  }
  if constexpr (std::is_same_v<std::decay_t<decltype(run)>, SpatialRunResult>) {
    for (const NamedDocument& file : paraview_files(input, run)) {
      outputs.add(file.name, file.text, id);
      names += ", " + file.name;
    }
    if (history.finish()) names += std::string(", ") + HistoryFiles::collection;
  }
  const std::string json = files.report();
  say(options, run_summary(input, run), json);
  publish(outputs, options, names + ", report.html");
  return status_of(run.verdict(), run.fallen_measure() > 0 || run.built.has_lost_lining());
}

}  // namespace

int run_verb(const Options& options) {
  work = {"reading " + options.file, "a smaller input file"};
  const Input input = read_input(voussoir::utf8_path(options.file), options.overrides);
  if (input.laid) return run_blocks_verb(options, input);
  if (input.is_spatial())
    return run_tunnel_verb(
        options, input, [&](const Report& report, HistoryFiles& history, StagePictures& pictures) {
          return spatial_run_of(input, report,
                                [&](const SpatialTunnel& tunnel, const StageResult& stage) {
                                  history.add(tunnel);
                                  pictures.add(tunnel, stage);
                                });
        });
  return run_tunnel_verb(
      options, input, [&](const Report& report, HistoryFiles&, StagePictures& pictures) {
        return run_of(input, report, [&](const Tunnel& tunnel, const StageResult& stage) {
          pictures.add(tunnel, stage);
        });
      });
}

int check_verb(const Options& options, bool wants_picture) {
  work = {"reading " + options.file, "a smaller input file"};
  const Input input = read_input(voussoir::utf8_path(options.file), options.overrides);
  if (input.laid) {
    const std::string count = std::to_string(input.laid->blocks.size());
    say(options, "blocks   " + count + " that are laid\nchecked  the file can be run\n",
        "{\n  \"schema\": 1,\n  \"laid_blocks\": " + count + "\n}\n");
    return finished;
  }
  ProgressLine line(options.quiet);
  work.remedy = smaller_model;
  const CheckedModel model = checked_model(input, [&](const std::string& what, double fraction) {
    now_doing(what, "making the model");
    return line.show(what, fraction);
  });
  line.clear();
  if (stop_asked != 0) return say_interrupted();
  say(options, check_text(input, model), check_json(input, model));
  if (!wants_picture) return finished;
  RunFolder outputs(options.folder);
  work.doing = "writing the results";
  const std::string id = RunId("check").add(input).text();
  outputs.add("check.svg", check_svg(input, model), id);
  if (input.survey) outputs.add("stereonet.svg", stereonet_svg(input), id);
  publish(outputs, options, input.survey ? "check.svg, stereonet.svg" : "check.svg");
  return finished;
}

int safety_verb(const Options& options, const SafetySettings& settings, bool wants_limit) {
  work = {"reading " + options.file, "a smaller input file"};
  const Input input = read_input(utf8_path(options.file), options.overrides);
  RunFolder outputs(options.folder);
  ProgressLine line(options.quiet);
  work.remedy = smaller_model;
  const Report report = [&](const std::string& what, double fraction) {
    now_doing(what, "computing with " + what);
    return line.show(what, fraction);
  };
  const std::string id = RunId("safety")
                             .add(input)
                             .add(settings.search.width)
                             .add(settings.search.most)
                             .add(settings.tolerated_loss)
                             .add(static_cast<int>(settings.limit))
                             .add(static_cast<int>(settings.from_start))
                             .add(static_cast<int>(settings.with_supports))
                             .add(static_cast<int>(wants_limit))
                             .text();
  const SafetyAnswer answer = safety_of(input, settings, wants_limit, report);
  line.clear();
  if (stop_asked != 0) return say_interrupted();
  work.doing = "writing the results";
  outputs.replace("safety.svg");  // where nothing falls there is none
  std::string names = "safety.json, safety.csv";
  const std::string json = safety_json(input, settings, answer);
  outputs.add("safety.json", json, id);
  outputs.add("safety.csv", safety_csv(answer), id);
  if (!answer.mechanism.empty()) {
    outputs.add("safety.svg", answer.mechanism, id);
    names += ", safety.svg";
  }
  say(options, safety_text(settings, answer), with_run_id("safety.json", json, id));
  publish(outputs, options, names);
  return answer.is_undecided() ? not_decided : finished;
}

int grc_verb(const Options& options, int steps) {
  work = {"reading " + options.file, "a smaller input file"};
  const Input input = read_input(utf8_path(options.file), options.overrides);
  if (input.laid)
    throw InvalidInput(options.file +
                       ": grc is of tunnels\n   = accepted: an input file with [tunnel]");
  RunFolder outputs(options.folder);
  ProgressLine line(options.quiet);
  work.remedy = smaller_model;
  const Report report = [&](const std::string& what, double fraction) {
    now_doing(what, "computing the stage " + what);
    return line.show(what, fraction);
  };
  const std::string id = RunId("grc").add(input).add(steps).text();
  std::string said, json, name;
  if (input.is_spatial()) {
    const LongitudinalProfile profile = longitudinal_profile(input, report);
    name = "profile";
    said = profile_text(profile);
    json = profile_json(profile);
    outputs.add("profile.csv", profile_csv(profile), id);
    outputs.add("profile.svg", profile_svg(input, profile), id);
  } else {
    const GroundReaction reaction = ground_reaction(input, steps, report);
    name = "grc";
    said = grc_text(reaction);
    json = grc_json(reaction);
    outputs.add("grc.csv", grc_csv(reaction), id);
    outputs.add("grc.svg", grc_svg(input, reaction), id);
  }
  line.clear();
  if (stop_asked != 0) return say_interrupted();
  work.doing = "writing the results";
  outputs.add(name + ".json", json, id);
  say(options, said, with_run_id(name + ".json", json, id));
  publish(outputs, options, name + ".json, " + name + ".csv, " + name + ".svg");
  return finished;
}

namespace {

/// "--length 0.5m" of a command line [m].
double bonded_length(const std::string& given) {
  const char* const accepted = "\n   = accepted: from 1 cm to 1000 m, such as --length \"0.5 m\"";
  try {
    const Quantity length = parse_quantity(given);
    if (length.dimension == dimension::length && length.value >= 0.01 && length.value <= 1000)
      return length.value;
  } catch (const UnitError& error) {
    throw InvalidInput("--length " + given + " " + error.complaint() + accepted);
  }
  throw InvalidInput("--length " + given + " is no bonded length" + accepted);
}

}  // namespace

int pullout_verb(const Options& options, const std::vector<std::string>& lengths) {
  work = {"reading " + options.file, "a smaller input file"};
  RunId run_id("pullout");
  std::vector<double> bonded;
  for (const std::string& length : lengths) bonded.push_back(bonded_length(length));
  const Input input = read_input(utf8_path(options.file), options.overrides);
  if (input.laid)
    throw InvalidInput(options.file +
                       ": pullout is of bolts, and blocks that are laid have none\n"
                       "   = accepted: an input file with [support.bolts]");
  RunFolder outputs(options.folder);
  run_id.add(input);
  for (const double length : bonded) run_id.add(length);
  const std::string id = run_id.text();
  const PullOutTests tests = pull_out_tests(input, bonded);
  work.doing = "writing the results";
  const std::string json = pull_out_json(tests);
  outputs.add("pullout.json", json, id);
  outputs.add("pullout.csv", pull_out_csv(tests), id);
  outputs.add("pullout.svg", pull_out_svg(input, tests), id);
  say(options, pull_out_text(tests), with_run_id("pullout.json", json, id));
  publish(outputs, options, "pullout.json, pullout.csv, pullout.svg");
  return finished;
}

int blocks_verb(const Options& options) {
  work = {"reading " + options.file, "a smaller input file"};
  const Input input = read_input(utf8_path(options.file), options.overrides);
  if (input.laid)
    throw InvalidInput(options.file +
                       ": blocks is of rock that joints cut, and here blocks are laid\n"
                       "   = accepted: an input file with [tunnel]");
  RunFolder outputs(options.folder);
  ProgressLine line(options.quiet);
  work.remedy = smaller_model;
  const RockBlocks rock = rock_blocks(input, [&](const std::string& what, double fraction) {
    now_doing(what, "looking at the blocks");
    return line.show(what, fraction);
  });
  line.clear();
  if (stop_asked != 0) return say_interrupted();
  work.doing = "writing the results";
  const std::string id = RunId("rock").add(input).text();
  std::string names = "blocks.json, block_sizes.csv, block_sizes.svg, removable.csv, rock.svg";
  outputs.add("blocks.json", rock_blocks_json(input, rock), id);
  outputs.add("block_sizes.csv", block_sizes_csv(input, rock), id);
  outputs.add("block_sizes.svg", block_sizes_svg(input, rock), id);
  outputs.add("removable.csv", removable_csv(input, rock), id);
  outputs.add("rock.svg", rock_svg(input, rock), id);
  if (input.is_spatial()) {
    outputs.add("wall.svg", wall_svg(input, rock), id);
    names += ", wall.svg";
  }
  if (input.survey) {
    outputs.add("stereonet.svg", stereonet_svg(input), id);
    names += ", stereonet.svg";
  }
  say(options, rock_blocks_text(input, rock),
      with_run_id("blocks.json", rock_blocks_json(input, rock), id));
  publish(outputs, options, names);
  return finished;
}

int init_verb(const std::string& name, const std::string& file) {
  const std::string text = template_text(name);
  if (file.empty()) {
    std::cout << text;
    return finished;
  }
  const std::filesystem::path path = voussoir::utf8_path(file);
  std::error_code error;
  if (std::filesystem::exists(path, error))
    throw voussoir::InvalidInput(file + " is there already\n   = accepted: the name of a new file");
  voussoir::write_atomically(path, text);
  std::cout << "written  " << file << "; voussoir check " << file << "; voussoir run " << file
            << "\n";
  return finished;
}

}  // namespace voussoir::program
