#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "canopeer/base/check.h"
#include "canopeer/base/expected.h"

namespace canopeer {

/// What can be chosen by name: for each name a line about it, and what makes it. A value; the names
/// stay in the order in which they were added. `Signature` is that of the factories.
template <typename Signature>
class NamedFactories {
 public:
  using Factory = std::function<Signature>;

  /// `kind`: what the factories make, for messages ("planner").
  explicit NamedFactories(std::string kind) : kind_(std::move(kind)) {}

  /// The error: the name is taken, or is anything but small letters, digits and '_'.
  [[nodiscard]] Expected<void> add(std::string name, std::string one_line, Factory factory) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_";
    if (name.empty() || name.find_first_not_of(kLetters) != std::string::npos) {
      return fail("a " + kind_ + " cannot be called '" + name +
                  "'; expected small letters, digits and '_'");
    }
    if (!factory) return fail("the " + kind_ + " '" + name + "' has no factory");
    if (entry(name) != nullptr) return fail("there is a " + kind_ + " '" + name + "' already");
    entries_.push_back({std::move(name), std::move(one_line), std::move(factory)});
    return {};
  }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const Entry& e : entries_) all.push_back(e.name);
    return all;
  }
  /// Empty: there is none of that name.
  [[nodiscard]] std::string one_line(std::string_view name) const {
    const Entry* const found = entry(name);
    return found == nullptr ? std::string() : found->one_line;
  }
  /// The error lists the names there are.
  [[nodiscard]] Expected<Factory> find(std::string_view name) const {
    if (const Entry* const found = entry(name)) return found->factory;
    std::string known;
    for (const Entry& e : entries_) known += (known.empty() ? "" : ", ") + e.name;
    return fail("unknown " + kind_ + " '" + std::string(name) + "'; there is: " + known);
  }

 protected:
  /// Adds one of the library's own.
  void put(const char* name, const char* one_line, Factory factory) {
    const auto added = add(name, one_line, std::move(factory));
    CANOPEER_CHECK(added.has_value(), "built-in names are good and differ");
  }

 private:
  struct Entry {
    std::string name;
    std::string one_line;
    Factory factory;
  };
  [[nodiscard]] const Entry* entry(std::string_view name) const {
    for (const Entry& e : entries_) {
      if (e.name == name) return &e;
    }
    return nullptr;
  }

  std::string kind_;
  std::vector<Entry> entries_;
};

}  // namespace canopeer
