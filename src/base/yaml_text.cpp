#include "slipscale/base/yaml_text.hpp"

#include <algorithm>
#include <set>

#include "slipscale/base/error.hpp"
#include "slipscale/base/plain_yaml.hpp"
#include "slipscale/base/print.hpp"
#include "yaml_node.hpp"

namespace slipscale {
namespace {

using yaml::Fault;
using yaml::Node;

/// Aliases of aliases grow without bound.
constexpr std::size_t most_entries = 1000000;

bool is_merge(const Node& key) { return key.plain && key.text == "<<"; }

/// A key as Python's yaml would print it, or a fault.
std::string key_text(const Node& key) {
  if (key.kind != Node::Kind::scalar)
    throw Fault{"has a key{} that is no word; write `name: value`", key.line};
  const PlainYaml meaning = key.plain ? plain_yaml(key.text) : PlainYaml::text;
  const bool odd = meaning == PlainYaml::number
                       ? key.text.find_first_not_of("0123456789") != std::string::npos
                       : meaning != PlainYaml::text;
  if (odd)
    throw Fault{"has a key{}, '" + key.text + "', that YAML takes for " + plain_yaml_words(key.text) +
                    "; put it in quotes",
                key.line};
  return key.text;
}

/// How odd a plain word is; of a list the oddest is remembered.
int rank(const std::string& word) { return word.empty() ? 0 : static_cast<int>(plain_yaml(word)); }

class Entries {
 public:
  /// Below `prefix`, which ends with _ or is empty.
  void add(const Node& map, const std::string& prefix) {
    std::set<std::string> own;
    for (const auto& [key, value] : map.pairs) {
      if (is_merge(*key)) continue;
      if (!own.insert(key_text(*key)).second)
        throw Fault{"gives '" + key->text + "' twice{}; put what belongs to it under one key", key->line};
      add_value(*value, prefix, *key);
    }
    for (const auto& [key, value] : map.pairs)
      if (is_merge(*key)) add_merged(*value, prefix, own);
  }

  std::vector<YamlEntry> take() { return std::move(entries_); }

 private:
  /// `<<: *base`: what the map does not give itself.
  void add_merged(const Node& source, const std::string& prefix, std::set<std::string>& own) {
    if (++merges_ > most_entries) throw Fault{"merges (<<) more than a million times{}", source.line};
    if (source.kind == Node::Kind::list) {
      for (const auto& item : source.items) add_merged(*item, prefix, own);
      return;
    }
    if (source.kind != Node::Kind::map)
      throw Fault{"merges (<<) something{} that does not consist of options", source.line};
    for (const auto& [key, value] : source.pairs) {
      if (is_merge(*key)) continue;
      if (own.insert(key_text(*key)).second) add_value(*value, prefix, *key);
    }
    for (const auto& [key, value] : source.pairs)
      if (is_merge(*key)) add_merged(*value, prefix, own);
  }

  void add_value(const Node& value, const std::string& prefix, const Node& key) {
    // PETSc's sign for what is only there to be referred to.
    if (prefix.empty() && key.text.starts_with("$$")) return;
    const std::string name = prefix + key.text;
    if (value.kind == Node::Kind::map) return add(value, name + "_");
    const char first = name.empty() ? ' ' : name[0];
    if (!(first >= 'a' && first <= 'z') && !(first >= 'A' && first <= 'Z') && first != '-')
      throw Fault{"has a name{} that no option can begin with; names begin with a letter", key.line};
    YamlEntry entry{name, std::nullopt, "", key.line};
    if (value.kind == Node::Kind::list)
      add_list(value, entry);
    else if (!value.plain || plain_yaml(value.text) != PlainYaml::nothing)
      add_word(value, entry);
    if (entries_.size() == most_entries) throw Fault{"has more than a million options{}", key.line};
    entries_.push_back(std::move(entry));
  }

  void add_list(const Node& list, YamlEntry& entry) {
    entry.value = "";
    for (const auto& item : list.items) {
      if (item->kind == Node::Kind::list)
        throw Fault{"has a list inside a list{}; write one flat list, x1, y1, x2, y2, …", item->line};
      if (item->kind == Node::Kind::map)
        throw Fault{"has options inside a list{}; a list holds numbers or words", item->line};
      if (item->text.find(',') != std::string::npos)
        throw Fault{"has a list{} with a comma inside an entry; write one entry for each", item->line};
      if (item != list.items.front()) *entry.value += ",";
      add_word(*item, entry);
    }
  }

  static void add_word(const Node& word, YamlEntry& entry) {
    if (word.plain && rank(word.text) > rank(entry.doubt)) entry.doubt = word.text;
    if (!entry.value) entry.value.emplace();
    *entry.value += word.text;  // in place: of a long list copies would cost its square
  }

  std::vector<YamlEntry> entries_;
  std::size_t merges_ = 0;
};

/// The line itself, so that the reader of the message sees at once what is meant.
std::string quoted_line(const std::string& text, int line) {
  std::size_t begin = 0;
  for (int k = 1; k < line && begin != std::string::npos; ++k) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  if (begin == std::string::npos || begin >= text.size()) return "";
  std::string shown = text.substr(begin, std::min<std::size_t>(text.find('\n', begin) - begin, 240));
  shown.erase(0, std::min(shown.find_first_not_of(" \t\r"), shown.size()));
  // What ends a message or a terminal's line, and the marks of UTF-16.
  std::ranges::replace_if(
      shown, [](unsigned char c) { return c < 0x20 || c == 0x7F || c >= 0xFE; }, '?');
  if (shown.size() > 60) {
    shown.resize(60);
    // Not in the middle of a letter.
    while (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xC0) == 0x80) shown.pop_back();
    if (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0x80) != 0) shown.pop_back();
    shown += "…";
  }
  return " (" + shown + ")";
}

}  // namespace

std::vector<YamlEntry> read_yaml(const std::string& file, const std::string& text) {
  try {
    const auto nul = text.find('\0');
    if (nul != std::string::npos)
      throw Fault{
          "has a NUL byte{}, so it is no text; remove it",
          1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(nul), '\n'))};
    const yaml::NodePointer root = yaml::parse(text);
    if (!root) return {};
    if (root->kind != Node::Kind::map)
      throw Fault{"does not consist of options{}; write `name: value`, with a blank after the colon",
                  root->line};
    Entries entries;
    entries.add(*root, "");
    return entries.take();
  } catch (const Fault& fault) {
    std::string sentence = fault.sentence;
    const std::string place =
        fault.line > 0 ? " near line " + std::to_string(fault.line) + quoted_line(text, fault.line) : "";
    sentence.replace(sentence.find("{}"), 2, place);
    throw UserError(file + " " + sentence);
  }
}

}  // namespace slipscale
