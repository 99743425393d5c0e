#include "fuel_caches.h"

#include <cstdlib>

namespace canopeer::app {

std::vector<std::filesystem::path> fuel_caches() {
  std::vector<std::filesystem::path> caches;
  for (const char* name : {"GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"}) {
    const char* const value = std::getenv(name);
    if (value != nullptr && *value != '\0') caches.emplace_back(value);
  }
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') return caches;
  for (const char* folder : {".gz/fuel", ".ignition/fuel"}) {
    caches.push_back(std::filesystem::path(home) / folder);
  }
  return caches;
}

}  // namespace canopeer::app
