#include "canopeer/config/yaml_document.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "canopeer/base/text_lines.h"

namespace canopeer {
namespace {

std::string at_line(const std::string& name, int line) {
  return line > 0 ? name + ":" + std::to_string(line) : name;
}

/// Copies yaml-cpp's tree. What is wrong with it goes to `trouble`, the first only.
class TreeCopy {
 public:
  TreeCopy(const std::string& name, bool keep_lines) : name_(name), keep_lines_(keep_lines) {}

  std::unique_ptr<YamlNode> copy(const YAML::Node& from, int depth = 0) {
    auto node = std::make_unique<YamlNode>();
    const int line = from.Mark().line + 1;
    node->line = keep_lines_ ? line : 0;
    if (depth > kMaxDepth || ++nodes_ > kMaxNodes) {
      note(line, "an alias (*name) repeats what holds it, or too much");
      return node;
    }
    switch (from.Type()) {
      case YAML::NodeType::Undefined:
      case YAML::NodeType::Null:
        break;
      case YAML::NodeType::Scalar:
        node->kind = YamlNode::Kind::kScalar;
        node->scalar = from.Scalar();
        node->quoted = from.Tag() == "!";
        break;
      case YAML::NodeType::Sequence:
        node->kind = YamlNode::Kind::kSequence;
        for (const YAML::Node& item : from) {
          if (!trouble_.empty()) break;
          node->items.push_back(copy(item, depth + 1));
        }
        break;
      case YAML::NodeType::Map:
        node->kind = YamlNode::Kind::kMap;
        for (const auto& entry : from) {
          if (!trouble_.empty()) break;
          copy_entry(entry.first, entry.second, depth, *node);
        }
        break;
    }
    return node;
  }

  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  // An alias can make a small file endless, or very large.
  static constexpr int kMaxDepth = 100;
  static constexpr int kMaxNodes = 1000000;

  void copy_entry(const YAML::Node& key_node, const YAML::Node& value_node, int depth,
                  YamlNode& node) {
    const int line = key_node.Mark().line + 1;
    if (!key_node.IsScalar()) return note(line, "a key must be a plain word");
    const std::string& key = key_node.Scalar();
    if (const YamlNode* const first = node.find(key)) {
      note(line, "key '" + key + "' is there twice" +
                     (keep_lines_ ? "; the first is on line " + std::to_string(first->line) : ""));
    }
    auto value = copy(value_node, depth + 1);
    // An entry is complained about where its key stands, a block mapping's too.
    if (keep_lines_) value->line = line;
    node.entries.emplace_back(key, std::move(value));
  }

  void note(int line, const std::string& what) {
    if (trouble_.empty()) trouble_ = at_line(name_, keep_lines_ ? line : 0) + ": " + what;
  }

  const std::string& name_;
  bool keep_lines_;
  int nodes_ = 0;
  std::string trouble_;
};

/// What the parser stumbled over, in words for people who indent with tabs.
std::string reason_of(const YAML::Exception& error, std::string_view text) {
  TextLines lines(text);
  while (const auto line = lines.next()) {
    if (lines.number() != error.mark.line + 1) continue;
    const std::string_view indent = line->substr(0, line->find_first_not_of(" \t"));
    if (indent.find('\t') != std::string_view::npos) {
      return "a tab indents this line; YAML wants blanks";
    }
  }
  return "not YAML: " + error.msg;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::string advice(const std::string& key, const std::set<std::string, std::less<>>& known) {
  const std::string nearest = nearest_name(key, known);
  if (!nearest.empty()) return "; did you mean '" + nearest + "'?";
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "; no key is expected here" : "; valid here: " + list;
}

void collect_unknown(const YamlNode& node, const YamlDocument& document,
                     std::vector<YamlDocument::Complaint>& complaints) {
  for (const auto& item : node.items) collect_unknown(*item, document, complaints);
  for (const auto& [key, value] : node.entries) {
    collect_unknown(*value, document, complaints);
    if (node.visited && node.asked.count(key) == 0)
      complaints.push_back(
          {false, value->line,
           document.place(*value) + ": unknown key '" + key + "'" + advice(key, node.asked)});
  }
}

}  // namespace

YamlNode* YamlNode::find(std::string_view key) const {
  for (const auto& [name, value] : entries) {
    if (name == key) return value.get();
  }
  return nullptr;
}

Expected<std::unique_ptr<YamlNode>> parse_yaml_value(std::string_view text, const std::string& name,
                                                     bool keep_lines) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(std::string(text));
    for (std::size_t i = 1; i < documents.size(); ++i) {
      if (documents[i].IsNull()) continue;
      return fail(at_line(name, keep_lines ? documents[i].Mark().line + 1 : 0) +
                  ": a second document begins here (after ---); a file must hold one");
    }
    TreeCopy tree(name, keep_lines);
    auto node = tree.copy(documents.empty() ? YAML::Node() : documents[0]);
    if (!tree.trouble().empty()) return fail(tree.trouble());
    return node;
  } catch (const YAML::Exception& error) {
    return fail(at_line(name, keep_lines ? error.mark.line + 1 : 0) + ": " +
                reason_of(error, text));
  }
}

Expected<std::shared_ptr<YamlDocument>> YamlDocument::parse(std::string_view text,
                                                            std::string name) {
  auto root = parse_yaml_value(text, name, true);
  if (!root) return fail(root.error().message);
  if ((*root)->kind != YamlNode::Kind::kMap)
    return fail(name + ": expected a mapping (key: value) at the top" +
                (text.starts_with('<') ? ". This is XML: a URDF is named in a robot file (urdf:), "
                                         "a world in a mission (world.import)"
                                       : ""));
  auto document = std::make_shared<YamlDocument>();
  document->name = std::move(name);
  document->root = std::move(*root);
  return document;
}

std::string YamlDocument::place(const YamlNode& node) const {
  return node.line > 0 ? at_line(name, node.line) : name + " (--set)";
}

std::unique_ptr<YamlDocument::Complaint> YamlDocument::first_complaint() const {
  std::vector<Complaint> all = complaints;
  collect_unknown(*root, *this, all);
  const auto first =
      std::min_element(all.begin(), all.end(), [](const Complaint& a, const Complaint& b) {
        return std::pair(a.missing, a.line) < std::pair(b.missing, b.line);
      });
  return first == all.end() ? nullptr : std::make_unique<Complaint>(*first);
}

std::string nearest_name(std::string_view name, const std::set<std::string, std::less<>>& known) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 2) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = candidate;
  }
  return best;
}

}  // namespace canopeer
