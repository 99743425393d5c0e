#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace canopeer {

/// The address of a model on the network, as Gazebo's server of models (Fuel) has them, or of a
/// file of one.
struct FuelAddress {
  std::string server;          ///< "fuel.gazebosim.org"
  std::string owner;           ///< in small letters; empty: the address has none
  std::string name;            ///< of the model, as people write it: "Double pendulum"
  std::string version;         ///< digits; empty: the newest
  std::filesystem::path file;  ///< below the model's folder; empty: the model itself

  /// How model paths mostly call it: in small letters, with "_" for blanks.
  [[nodiscard]] std::string folder_name() const;
};

/// Of `https://fuel.gazebosim.org/1.0/Owner/models/Name`, with or without `/2` or `/tip` and
/// `/files/meshes/a.dae` after it, of `https://app.gazebosim.org/Owner/fuel/models/Name`, and of
/// addresses elsewhere, whose last part is the name. Nothing: no http:// or https:// address.
[[nodiscard]] std::optional<FuelAddress> parse_fuel_address(const std::string& uri);

/// Where programs of Gazebo keep a model they have fetched, below one of `caches` ("~/.gz/fuel"):
/// server/owner/models/name/version. The newest version first; without a version that is there, the
/// folder that would hold it.
[[nodiscard]] std::vector<std::filesystem::path> cached_folders(
    const FuelAddress& address, const std::vector<std::filesystem::path>& caches);

}  // namespace canopeer
