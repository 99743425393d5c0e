#include "canopeer/import/assembly/name_patterns.h"

#include <algorithm>
#include <regex>

namespace canopeer {
namespace {

constexpr std::size_t kLongestName = 300;  // std::regex recurses; no sensible name is longer

using Pattern = std::optional<std::regex>;

Expected<Pattern> compile_one(const char* what, const std::string& text) {
  if (text.empty()) return Pattern();
  try {
    return Pattern(std::regex(text, std::regex::ECMAScript | std::regex::optimize));
  } catch (const std::regex_error& error) {
    return fail(std::string(what) + ": '" + text + "' is no regular expression: " + error.what());
  }
}

bool matches(const Pattern& pattern, const std::string& name) {
  return pattern && !name.empty() && std::regex_search(name.substr(0, kLongestName), *pattern);
}

bool any_matches(const Pattern& pattern, const PartNames& names) {
  const auto all = all_names(names);
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& name) { return matches(pattern, name); });
}

}  // namespace

struct NamePatterns::Compiled {
  Pattern fruit;
  Pattern counted;
  Pattern leaf;
  Pattern stem;
  Pattern plant;
  Pattern skip;
};

std::vector<std::string> all_names(const PartNames& names) {
  std::vector<std::string> all = {names.material};
  all.insert(all.end(), names.textures.begin(), names.textures.end());
  all.insert(all.end(),
             {names.mesh, names.node, names.file, names.visual, names.link, names.model});
  return all;
}

Expected<NamePatterns> NamePatterns::compile(const NamePatternOptions& options) {
  Compiled compiled;
  for (auto& [what, text, pattern] : {std::tuple{"fruit", &options.fruit, &compiled.fruit},
                                      std::tuple{"counted", &options.counted, &compiled.counted},
                                      std::tuple{"leaf", &options.leaf, &compiled.leaf},
                                      std::tuple{"stem", &options.stem, &compiled.stem},
                                      std::tuple{"plant", &options.plant, &compiled.plant},
                                      std::tuple{"skip", &options.skip, &compiled.skip}}) {
    auto one = compile_one(what, *text);
    if (!one) return tl::unexpected(one.error());
    *pattern = std::move(*one);
  }
  NamePatterns patterns;
  patterns.options_ = options;
  patterns.compiled_ = std::make_shared<const Compiled>(std::move(compiled));
  return patterns;
}

std::optional<PartClass> NamePatterns::class_of(const PartNames& names) const {
  for (const std::string& name : all_names(names)) {
    if (matches(compiled_->fruit, name)) return PartClass::fruit;
    if (matches(compiled_->leaf, name)) return PartClass::leaf;
    if (matches(compiled_->stem, name)) return PartClass::stem;
  }
  return std::nullopt;
}

bool NamePatterns::counted(const PartNames& names) const {
  return !compiled_->counted || any_matches(compiled_->counted, names);
}

bool NamePatterns::plant(const PartNames& names) const {
  return matches(compiled_->plant, names.model);
}

bool NamePatterns::skip(const PartNames& names) const {
  return any_matches(compiled_->skip, names);
}

}  // namespace canopeer
