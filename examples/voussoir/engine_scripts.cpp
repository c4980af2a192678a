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

/// `text` with every {word} replaced by its value.
std::string filled(std::string text, const std::map<std::string, std::string>& values) {
  for (const auto& [word, value] : values)
    for (std::size_t at = text.find(word); at != std::string::npos;
         at = text.find(word, at + value.size()))
      text.replace(at, word.size(), value);
  return text;
}

std::string slurm_script(const CasePlan& plan, const Engine& engine) {
  const std::string verb = to_string(plan.parts().verb), folder = utf8_text(engine.folder);
  return "#!/bin/bash\n" + heading(plan, engine) +
         filled(R"(#
#   sbatch @SCRIPT
#       starts it, or starts it again after anything: a finished case is never computed twice
#   voussoir merge @FOLDER
#       says what is missing, or writes the results
#
# Partition, account and memory are what your site asks for:
##SBATCH --partition=NAME
##SBATCH --account=NAME
##SBATCH --mem-per-cpu=2G
#SBATCH --job-name=voussoir-@VERB
#SBATCH --array=1-@CHUNKS
#SBATCH --cpus-per-task=1
#SBATCH --time=@TIME
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=voussoir-@VERB-%a.log

program=@PROGRAM
plan=@PLAN
"$program" case "$plan" --chunk "$SLURM_ARRAY_TASK_ID/@CHUNKS" --threads "${SLURM_CPUS_PER_TASK:-1}"
status=$?
# Killed (no memory left, kill -9): back into the queue, twice at most.
if ((status > 130 && ${SLURM_RESTART_COUNT:-0} < 2)); then
  echo "chunk $SLURM_ARRAY_TASK_ID was ended by signal $((status - 128)); it is queued again"
  scontrol requeue "$SLURM_JOB_ID" && sleep 60 # until Slurm ends this script
fi
exit "$status"
)",
                {{"@SCRIPT", shell_quoted(folder + "/" + verb + ".slurm.sh")},
                 {"@FOLDER", shell_quoted(folder)},
                 {"@VERB", verb},
                 {"@CHUNKS", std::to_string(engine.chunks)},
                 {"@TIME", clock_text(engine.minutes)},
                 {"@PROGRAM", shell_quoted(utf8_text(engine.program))},
                 {"@PLAN", shell_quoted(folder + "/" + verb + ".plan.json")}});
}

std::string snakefile(const CasePlan& plan, const Engine& engine,
                      const std::vector<std::string>& results) {
  const std::string verb = to_string(plan.parts().verb);
  std::string outputs;
  for (const std::string& name : results)
    outputs += (outputs.empty() ? "" : ", ") + std::string("FOLDER + ") + double_quoted("/" + name);
  return heading(plan, engine) + filled(R"(PROGRAM = @PROGRAM
FOLDER = @FOLDER
PLAN = FOLDER + "/@VERB.plan.json"
CHUNKS = @CHUNKS
DONE = FOLDER + "/@VERB.journal/chunk-{k}.done"


# Snakemake's notes and its lock lie beside the results, wherever it is started.
workdir: FOLDER


localrules: all, merge


rule all:
    input: @OUTPUTS


rule merge:
    input: expand(DONE, k=range(1, CHUNKS + 1))
    output: @OUTPUTS
    shell: "{PROGRAM:q} merge {PLAN:q}"


# A chunk that was killed is run again: its finished cases are not. The output is a mark, not the
# journal: Snakemake removes the output of a job that failed.
rule chunk:
    output: touch(DONE)
    threads: 1
    resources: runtime=@MINUTES, mem_mb=2000
    shell: "{PROGRAM:q} case {PLAN:q} --chunk {wildcards.k}/{CHUNKS} --threads {threads}"
)",
                                        {{"@PROGRAM", double_quoted(utf8_text(engine.program))},
                                         {"@FOLDER", double_quoted(utf8_text(engine.folder))},
                                         {"@VERB", verb},
                                         {"@CHUNKS", std::to_string(engine.chunks)},
                                         {"@OUTPUTS", outputs},
                                         {"@MINUTES", std::to_string(engine.minutes)}});
}

const char* const profile_local = R"(# snakemake --profile with this folder: on this machine.
cores: all
keep-going: true
rerun-incomplete: true
restart-times: 2
printshellcmds: true
)";

std::string profile_slurm(const CasePlan& plan, const Engine& engine) {
  const std::string verb = to_string(plan.parts().verb), folder = utf8_text(engine.folder);
  return filled(
      R"(# snakemake --profile with this folder: each chunk is a job of Slurm. Snakemake 7; 8 and newer read
# config.v8+.yaml instead.
cluster: @SUBMIT
cluster-status: @STATUS
cluster-cancel: scancel
jobs: 100
keep-going: true
rerun-incomplete: true
restart-times: 2
latency-wait: 60
printshellcmds: true
)",
      {{"@SUBMIT",
        double_quoted("sbatch --parsable --requeue --open-mode=append --job-name=voussoir-" + verb +
                      "-{wildcards.k} --cpus-per-task={threads} "
                      "--time={resources.runtime} --output=" +
                      shell_quoted(folder + "/" + verb + ".journal/slurm-%j.log"))},
       {"@STATUS", double_quoted("bash " + shell_quoted(folder + "/" + verb + ".slurm/status"))}});
}

const char* const profile_slurm_8 =
    R"(# snakemake --profile with this folder: each chunk is a job of Slurm. Snakemake 8 and newer, with
# the package snakemake-executor-plugin-slurm; 7 reads config.yaml instead.
executor: slurm
default-resources:
#  slurm_account: NAME
#  slurm_partition: NAME
  slurm_extra: "'--requeue --open-mode=append'"
jobs: 100
keep-going: true
rerun-incomplete: true
restart-times: 2
latency-wait: 60
printshellcmds: true
)";

const char* const slurm_status = R"(#!/bin/bash
# Says to Snakemake 7 how job $1 stands: success, failed or running.
state=$(scontrol show job "$1" --oneliner 2>/dev/null | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
[[ -n $state ]] || state=$(sacct -X -n -o State -j "$1" 2>/dev/null | head -n 1)
case $state in
  COMPLETED*) echo success ;;
  *BOOT_FAIL* | *CANCELLED* | *DEADLINE* | *FAILED* | *NODE_FAIL* | *OUT_OF_ME* | *TIMEOUT*)
    echo failed ;;
  *) echo running ;;
esac
)";

}  // namespace

std::map<std::string, std::string> engine_scripts(const CasePlan& plan, const Engine& engine,
                                                  const std::vector<std::string>& results) {
  const std::string verb = to_string(plan.parts().verb);
  if (engine.name == "slurm") return {{verb + ".slurm.sh", slurm_script(plan, engine)}};
  if (engine.name == "snakemake")
    return {{verb + ".snakefile", snakefile(plan, engine, results)},
            {verb + ".local/config.yaml", profile_local},
            {verb + ".slurm/config.yaml", profile_slurm(plan, engine)},
            {verb + ".slurm/config.v8+.yaml", profile_slurm_8},
            {verb + ".slurm/status", slurm_status}};
  throw InvalidInput("--plan " + engine.name + "\n   = accepted: slurm, snakemake");
}

std::string engine_advice(const CasePlan& plan, const Engine& engine) {
  const std::string verb = to_string(plan.parts().verb), folder = utf8_text(engine.folder);
  const std::string starter = engine.name == "slurm" ? "sbatch" : "snakemake";
  const std::string elsewhere =
      finds_program(starter) ? ""
                             : "note     there is no " + starter +
                                   " on this machine: take the folder to one that has it, and "
                                   "edit program and paths in what is written\n";
  if (engine.name == "slurm")
    return elsewhere + "next     sbatch " + shell_quoted(folder + "/" + verb + ".slurm.sh") +
           "\n         voussoir merge " + shell_quoted(folder) +
           "   (when it has ended, or to see what is missing)\n";
  return elsewhere + "next     snakemake -s " + shell_quoted(folder + "/" + verb + ".snakefile") +
         " --profile " + shell_quoted(folder + "/" + verb + ".local") + "\n         or with " +
         verb + ".slurm in its place: each chunk is then a job of Slurm\n";
}

}  // namespace voussoir::program
