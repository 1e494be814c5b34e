#include "harness/verbs/usage/completion_script.h"

#include <CLI/CLI.hpp>
#include <vector>

namespace photonproof::inline harness_verbs_usage {
namespace {

/// A word to complete, with its text in one line.
struct Word {
  std::string word, text;
};

/// A verb, or a verb and its subcommand ("generate million"), with the words that may follow.
struct Context {
  std::string path;
  std::vector<Word> words;
};

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::vector<const CLI::App*> shown_subcommands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
}

std::vector<Word> words_after(const CLI::App& app) {
  std::vector<Word> words;
  for (const CLI::App* sub : shown_subcommands(app))
    words.push_back({sub->get_name(), first_line(sub->get_description())});
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
      words.push_back({"--" + name, first_line(option->get_description())});
  return words;
}

void add_contexts(const CLI::App& app, const std::string& path, std::vector<Context>& all) {
  all.push_back({path, words_after(app)});
  for (const CLI::App* sub : shown_subcommands(app))
    add_contexts(*sub, path.empty() ? sub->get_name() : path + " " + sub->get_name(), all);
}

/// Between single quotes, as all three shells read it.
std::string quoted(const std::string& text, Shell shell) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'')
      out += shell == Shell::fish ? "\\'" : "'\\''";
    else if (c == '\\' && shell == Shell::fish)
      out += "\\\\";
    else
      out += c;
  }
  return out + "'";
}

/// Lines that find the verb and its subcommand among the words from `from` to before `to`, numbers in the shell's array
/// `words`: `verb` becomes "" or "generate million". (In zsh a variable `path` would be the search path.)
std::string lines_of_verb(const std::vector<Context>& contexts, const std::string& from, const std::string& to) {
  std::string known;
  for (const Context& context : contexts)
    if (!context.path.empty()) known += (known.empty() ? "" : "|") + quoted(context.path, Shell::bash);
  return "  local verb= word i\n"
         "  for ((i = " +
         from + "; i < " + to +
         "; i++)); do\n"
         "    word=${words[i]}\n"
         "    case \"${verb:+$verb }$word\" in\n"
         "      " +
         known +
         ") verb=\"${verb:+$verb }$word\" ;;\n"
         "    esac\n"
         "  done\n";
}

std::string bash_script(const std::vector<Context>& contexts) {
  std::string out =
      "# Completion of photonproof for bash.\n"
      "_photonproof() {\n"
      "  local words=(\"${COMP_WORDS[@]}\") current=${COMP_WORDS[COMP_CWORD]} list=\n" +
      lines_of_verb(contexts, "1", "COMP_CWORD") + "  case $verb in\n";
  for (const Context& context : contexts) {
    std::string list;
    for (const Word& word : context.words) list += (list.empty() ? "" : " ") + word.word;
    out += "    " + quoted(context.path, Shell::bash) + ")\n      list=" + quoted(list, Shell::bash) + "\n";
    out += "      ;;\n";
  }
  return out +
         "  esac\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$list\" -- \"$current\")\n"
         "}\n"
         "complete -o bashdefault -o default -F _photonproof photonproof\n";
}

std::string zsh_script(const std::vector<Context>& contexts) {
  std::string out = "#compdef photonproof\n_photonproof() {\n  local -a list\n" +
                    lines_of_verb(contexts, "2", "CURRENT") + "  case $verb in\n";
  for (const Context& context : contexts) {
    out += "    " + quoted(context.path, Shell::zsh) + ") list=(\n";
    for (const Word& word : context.words) {
      std::string text = word.text;
      for (std::size_t at = 0; (at = text.find(':', at)) != std::string::npos; at += 2) text.insert(at, "\\");
      out += "      " + quoted(word.word + ":" + text, Shell::zsh) + "\n";
    }
    out += "    ) ;;\n";
  }
  return out +
         "  esac\n"
         "  [[ $words[CURRENT] == -* || $list[1] != -* ]] && _describe photonproof list\n"
         "  [[ $words[CURRENT] == -* || -z $verb ]] || _files\n"
         "}\n"
         "_photonproof \"$@\"\n";
}

std::string fish_script(const std::vector<Context>& contexts) {
  std::string out = "# Completion of photonproof for fish.\n";
  for (const Context& context : contexts) {
    std::string condition;
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos && !context.path.empty(); begin = end + 1) {
      end = context.path.find(' ', begin);
      condition += (condition.empty() ? "" : "; and ") +
                   ("__fish_seen_subcommand_from " + context.path.substr(begin, end - begin));
      if (end == std::string::npos) break;
    }
    if (condition.empty()) condition = "__fish_use_subcommand";
    for (const Word& word : context.words) {
      const bool is_option = word.word.starts_with("--");
      out += "complete -c photonproof -n " + quoted(condition, Shell::fish) + (is_option ? " -l " : " -a ") +
             quoted(is_option ? word.word.substr(2) : word.word, Shell::fish) + " -d " +
             quoted(word.text, Shell::fish) + "\n";
    }
  }
  return out;
}

}  // namespace

std::string completion_script(const CLI::App& program, Shell shell) {
  std::vector<Context> contexts;
  add_contexts(program, "", contexts);
  switch (shell) {
    case Shell::bash:
      return bash_script(contexts);
    case Shell::zsh:
      return zsh_script(contexts);
    case Shell::fish:
      return fish_script(contexts);
  }
  return "";
}

}  // namespace photonproof::inline harness_verbs_usage
