// SPDX-License-Identifier: MIT
#include "engine_scripts.hpp"

#include <cstdio>
#include <stdexcept>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/io/operating_system.hpp>

namespace voussoir::program {

namespace {

/// For a shell, whatever the text has in it.
std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// For Python, and for JSON, which YAML reads.
std::string double_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string clock_text(int minutes) {
  char text[32];
  std::snprintf(text, sizeof text, "%02d:%02d:00", minutes / 60, minutes % 60);
  return text;
}

std::string heading(const CasePlan& plan, const Engine& engine) {
  return std::string("# ") + to_string(plan.parts().verb) + " of " + plan.parts().file + ": " +
         std::to_string(plan.size()) + " cases in " + std::to_string(engine.chunks) +
         (engine.chunks == 1 ? " chunk" : " chunks") + ".\n# Written by voussoir " +
         VOUSSOIR_VERSION_STRING + "; yours to read and to edit.\n";
}

std::string slurm_script(const CasePlan& plan, const Engine& engine) {
  const std::string verb = to_string(plan.parts().verb), folder = utf8_text(engine.folder),
                    chunks = std::to_string(engine.chunks);
  return "#!/bin/bash\n" + heading(plan, engine) +
         "#\n"
         "#   sbatch " +
         shell_quoted(folder + "/" + verb + ".slurm.sh") +
         "\n"
         "#       starts it, or starts it again after anything: a finished case is never computed "
         "twice\n"
         "#   voussoir merge " +
         shell_quoted(folder) +
         "\n"
         "#       says what is missing, or writes the results\n"
         "#\n"
         "# Partition, account and memory are what your site asks for:\n"
         "##SBATCH --partition=NAME\n"
         "##SBATCH --account=NAME\n"
         "##SBATCH --mem-per-cpu=2G\n"
         "#SBATCH --job-name=voussoir-" +
         verb +
         "\n"
         "#SBATCH --array=1-" +
         chunks +
         "\n"
         "#SBATCH --cpus-per-task=1\n"
         "#SBATCH --time=" +
         clock_text(engine.minutes) +
         "\n"
         "#SBATCH --requeue\n"
         "#SBATCH --open-mode=append\n"
         "#SBATCH --output=" +
         double_quoted(folder + "/" + verb + ".journal/slurm-%a.log") +
         "\n"
         "exec " +
         shell_quoted(utf8_text(engine.program)) + " case " +
         shell_quoted(folder + "/" + verb + ".plan.json") +
         " \\\n  --chunk \"$SLURM_ARRAY_TASK_ID/" + chunks +
         "\" --threads \"${SLURM_CPUS_PER_TASK:-1}\"\n";
}

std::string snakefile(const CasePlan& plan, const Engine& engine,
                      const std::vector<std::string>& results) {
  const std::string verb = to_string(plan.parts().verb);
  std::string outputs;
  for (const std::string& name : results)
    outputs += (outputs.empty() ? "" : ", ") + std::string("FOLDER + ") + double_quoted("/" + name);
  return heading(plan, engine) + "PROGRAM = " + double_quoted(utf8_text(engine.program)) +
         "\nFOLDER = " + double_quoted(utf8_text(engine.folder)) + "\nPLAN = FOLDER + " +
         double_quoted("/" + verb + ".plan.json") + "\nCHUNKS = " + std::to_string(engine.chunks) +
         "\nDONE = FOLDER + " + double_quoted("/" + verb + ".journal/chunk-{k}.done") +
         "\n\n\n"
         "rule all:\n"
         "    input: " +
         outputs +
         "\n\n\n"
         "rule merge:\n"
         "    input: expand(DONE, k=range(1, CHUNKS + 1))\n"
         "    output: " +
         outputs +
         "\n"
         "    shell: \"{PROGRAM:q} merge {PLAN:q}\"\n"
         "\n\n"
         "# A chunk that was killed is run again: its finished cases are not.\n"
         "rule chunk:\n"
         "    output: touch(DONE)\n"
         "    threads: 1\n"
         "    resources: runtime=" +
         std::to_string(engine.minutes) +
         ", mem_mb=2000\n"
         "    shell: \"{PROGRAM:q} case {PLAN:q} --chunk {wildcards.k}/{CHUNKS} --threads "
         "{threads}\"\n";
}

const char* const profile_local =
    "# snakemake --profile with this folder: on this machine.\n"
    "cores: all\n"
    "keep-going: true\n"
    "rerun-incomplete: true\n"
    "printshellcmds: true\n";

std::string profile_slurm(const CasePlan& plan, const Engine& engine) {
  const std::string verb = to_string(plan.parts().verb);
  return "# snakemake --profile with this folder: each chunk is a job of Slurm.\n"
         "# Snakemake 8 and newer have no `cluster`: put `executor: slurm` in its place.\n"
         "cluster: " +
         double_quoted(
             "sbatch --parsable --requeue --open-mode=append --job-name=voussoir-" + verb +
             " --cpus-per-task={threads} --time={resources.runtime} --output=" +
             shell_quoted(utf8_text(engine.folder) + "/" + verb + ".journal/slurm-%j.log")) +
         "\n"
         "jobs: 100\n"
         "keep-going: true\n"
         "rerun-incomplete: true\n"
         "restart-times: 2\n"
         "latency-wait: 60\n"
         "printshellcmds: true\n";
}

}  // namespace

std::map<std::string, std::string> engine_scripts(const CasePlan& plan, const Engine& engine,
                                                  const std::vector<std::string>& results) {
  const std::string verb = to_string(plan.parts().verb);
  if (engine.name == "slurm") return {{verb + ".slurm.sh", slurm_script(plan, engine)}};
  if (engine.name == "snakemake")
    return {{verb + ".snakefile", snakefile(plan, engine, results)},
            {verb + ".local/config.yaml", profile_local},
            {verb + ".slurm/config.yaml", profile_slurm(plan, engine)}};
  throw InvalidInput("--plan " + engine.name + "\n   = accepted: slurm, snakemake");
}

std::string engine_advice(const CasePlan& plan, const Engine& engine) {
  const std::string verb = to_string(plan.parts().verb), folder = utf8_text(engine.folder);
  if (engine.name == "slurm")
    return "next     sbatch " + shell_quoted(folder + "/" + verb + ".slurm.sh") +
           "\n         voussoir merge " + shell_quoted(folder) +
           "   (when it has ended, or to see what is missing)\n";
  return "next     snakemake -s " + shell_quoted(folder + "/" + verb + ".snakefile") +
         " --profile " + shell_quoted(folder + "/" + verb + ".local") + "   (or ." + "slurm)\n";
}

}  // namespace voussoir::program
