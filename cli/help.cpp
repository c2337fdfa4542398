#include "cli/help.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cli/output_option.h"

namespace pstrips::cli {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::size_t kTextColumn = 28;  // where descriptions begin
constexpr std::size_t kMaxPlaceholder = 22;

constexpr std::string_view kExitCodes =
    "Exit codes: 0 ok, 1 command line, 2 input or output, 3 invalid file, 4 runtime, "
    "5 unsupported, 7 difference found, or a loss with --strict.";

struct Word {
  std::string_view word, meaning;
};

// Every word of the help that a dictionary does not explain.
constexpr Word kWords[] = {
    {"ACMR", "Average cache miss ratio: vertices that a cache of 16 (FIFO) lacks, per triangle."},
    {"attribute", "What a mesh says of its wedges beside the position: NORMAL, TEXCOORD_0 ..."},
    {"base", "The coarsest level; the packets refine it."},
    {"corner", "A vertex of a face, as that face sees it."},
    {"diagonal", "Length of the diagonal of the box that holds the model, along the axes."},
    {"dual edge", "A step from a triangle to its neighbour."},
    {"error bound",
     "How far a level and the full model are apart at most, proven for each packet."},
    {"Hausdorff distance", "The farthest that a point of one surface is from the other surface."},
    {"index", "A number that names a vertex to the graphics card."},
    {"index map", "The strips of all levels as one list, whose entries the packets rewrite."},
    {"level", "The model at one fineness: the base and some packets."},
    {"move", "A change of the strips that the search tries."},
    {"offset", "An entry of the index map that says how far to go on rather than which wedge."},
    {"packet", "A run of vertex splits: the piece by which a file refines."},
    {"primitive", "What glTF draws in one go: a piece of a mesh with one material."},
    {"profile", "What a decoder has to know to read a file."},
    {"qem", "Quadric error metric: squared distances to the planes of replaced faces."},
    {"RMS", "Root of the mean of the squared distances between two surfaces."},
    {"strip", "Triangles in a row: each index after the second makes one more."},
    {"subset", "Every vertex of a level is one of the full model's, where it stands there."},
    {"swap", "An index more in a strip, which turns it."},
    {"tunnel", "A way through strips along which changing places leaves one strip fewer."},
    {"vsplit", "Vertex split: one vertex becomes two, which brings triangles back."},
    {"wedge", "A vertex with one set of attributes; a seam has several of a vertex."},
};

bool is_rare(const std::string& group) {
  return group == kRareProgressiveGroup || group == kRareStripsGroup || group == kLimitsGroup;
}

// "-o,--output" as "-o, --output", with what the option takes.
std::string names_of(const CLI::Option& option, const std::string& placeholder) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  return placeholder.empty() ? list : list + " " + placeholder;
}

std::string description_of(const CLI::Option& option, const std::string& type) {
  std::string text = option.get_description();
  if (type.size() > kMaxPlaceholder && type.find('|') != type.npos) {
    std::string words = type;
    for (std::size_t at = 0; (at = words.find('|', at)) != words.npos; at += 2)
      words.replace(at, 1, ", ");
    text += ": " + words;
  }
  const std::string& value = option.get_default_str();
  if (!value.empty()) text += fmt::format(" (default {})", value);
  return text;
}

std::string row(const std::string& names, const std::string& text) {
  std::string out = "  " + names;
  if (out.size() + 2 > kTextColumn)
    out += "\n" + std::string(kTextColumn, ' ');
  else
    out.resize(kTextColumn, ' ');
  return out + wrapped(text, kTextColumn, kTextColumn) + "\n";
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string option_row(const CLI::Option& option) {
  if (option.get_positional())
    return row(names_of(option, ""), "Names " + upper(option.get_name(true)) + " instead");
  const std::string type = option.get_type_size() == 0 ? "" : option.get_type_name();
  const std::string placeholder = type.size() > kMaxPlaceholder ? "NAME" : type;
  return row(names_of(option, placeholder), description_of(option, type));
}

std::vector<const CLI::Option*> positionals(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

std::string usage(const CLI::App& app, const std::string& name) {
  std::string out = "Usage: " + name + " [OPTIONS]";
  for (const CLI::Option* argument : positionals(app)) {
    const bool repeats = argument->get_items_expected_max() > 1;
    out += " " + upper(argument->get_name(true)) + (repeats ? " ..." : "");
  }
  if (!app.get_subcommands({}).empty()) out += " COMMAND";
  return out + "\n\n" + wrapped(app.get_description(), 0, 0) + ".\n";
}

std::string arguments(const CLI::App& app) {
  std::string out;
  for (const CLI::Option* argument : positionals(app))
    out += row(upper(argument->get_name(true)), argument->get_description());
  return out.empty() ? out : "\nArguments:\n" + out;
}

std::string commands(const CLI::App& app) {
  std::string out;
  for (const CLI::App* command : app.get_subcommands({}))
    out += row(command->get_name(), command->get_description());
  return out.empty() ? out : "\nCommands:\n" + out;
}

bool is_help(const CLI::Option* option) {
  return std::ranges::find_if(option->get_lnames(), [](const std::string& name) {
           return name.starts_with("help");
         }) != option->get_lnames().end();
}

// Those of one group; help comes last.
std::string group_of(const CLI::App& app, const std::string& group) {
  auto members = app.get_options(
      [&](const CLI::Option* o) { return o->get_group() == group && o->nonpositional(); });
  std::ranges::stable_partition(members, std::not_fn(is_help));
  std::string out;
  for (const CLI::Option* option : members) out += option_row(*option);
  return out.empty() ? out : "\n" + group + ":\n" + out;
}

std::size_t count_rare(const CLI::App& app) {
  return app.get_options([](const CLI::Option* o) { return is_rare(o->get_group()); }).size();
}

std::string glossary() {
  std::string out = "\nWords:\n";
  for (const Word& word : kWords) out += row(std::string(word.word), std::string(word.meaning));
  return out;
}

std::string options(const CLI::App& app, bool all) {
  std::string out;
  for (const std::string& group : app.get_groups())
    if (!is_rare(group)) out += group_of(app, group);
  if (all)
    for (const std::string& group : app.get_groups())
      if (is_rare(group)) out += group_of(app, group);
  return out;
}

class HelpFormatter : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const bool all = mode != CLI::AppFormatMode::Normal;
    std::string out = usage(*app, name) + arguments(*app) + commands(*app) + options(*app, all);
    if (all) out += glossary();
    const std::size_t rare = count_rare(*app);
    if (!all)
      out += "\n" +
             wrapped(rare == 0 ? "--help-all explains the words."
                               : fmt::format("--help-all lists {} more options and "
                                             "explains the words.",
                                             rare),
                     0, 0) +
             "\n";
    return out + "\n" + wrapped(kOverwriteRule, 0, 0) + "\n" + wrapped(kExitCodes, 0, 0) + "\n";
  }
};

}  // namespace

std::string wrapped(std::string_view text, std::size_t first_column, std::size_t indent) {
  std::string out;
  std::size_t column = first_column;
  bool at_start = true;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find(' '), text.size());
    if (!at_start && column + 1 + length > kColumns) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!at_start) {
      out += ' ';
      ++column;
    }
    out += text.substr(0, length);
    column += length;
    at_start = false;
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return out;
}

void set_help(CLI::App& app) {
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "Print the options that matter first, and exit");
  app.set_help_all_flag("--help-all", "Print all options and what the words mean, and exit");
}

}  // namespace pstrips::cli
