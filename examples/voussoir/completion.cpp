// SPDX-License-Identifier: MIT
#include "completion.hpp"

#include "key_catalogue.hpp"

namespace voussoir::program {

namespace {

/// All long names and, where there is none, the short ones.
std::string options_of(const CLI::App& verb) {
  std::string words;
  for (const CLI::Option* option : verb.get_options()) {
    if (option->get_positional()) continue;
    for (const std::string& name : option->get_lnames()) words += " --" + name;
    if (option->get_lnames().empty())
      for (const std::string& name : option->get_snames()) words += " -" + name;
  }
  return words;
}

/// Keys with a value, of lists the first entry.
std::string key_words() {
  std::string words;
  for (const DeclaredKey& key : key_catalogue()) {
    using Kind = KeyForm::Kind;
    const Kind kind = key.form.kind;
    if (kind == Kind::table || kind == Kind::tables || kind == Kind::one_or_more) continue;
    std::string name = key.key;
    for (std::size_t at; (at = name.find("[]")) != std::string::npos;) name.insert(at + 1, 1, '0');
    words.append(1, ' ').append(name).append(1, '=');
  }
  return words;
}

}  // namespace

std::string completion_script(const CLI::App& app, std::string_view shell) {
  std::string verbs, cases;
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_group().empty()) continue;  // not in this build
    verbs += " " + verb->get_name();
    cases += "    " + verb->get_name() + ") words=\"" + options_of(*verb) + "\" ;;\n";
  }
  std::string script =
      "# Completion of voussoir for " + std::string(shell) + ": source this file.\n";
  if (shell == "zsh") script += "autoload -U +X bashcompinit && bashcompinit\n";
  script += R"(_voussoir() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]} words=
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W ")" +
            verbs + R"(" -- "$word"))
    return
  fi
  if [ "$before" = --set ] || [ "$before" = --vary ]; then
    compopt -o nospace 2>/dev/null
    COMPREPLY=($(compgen -W ")" +
            key_words() + R"(" -- "$word"))
    return
  fi
  case $verb in
)" + cases + R"(  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}
complete -o filenames -F _voussoir voussoir
)";
  return script;
}

}  // namespace voussoir::program
