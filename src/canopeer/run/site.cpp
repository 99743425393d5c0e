#include "canopeer/run/site.h"

#include "canopeer/run/simulation_site.h"

namespace canopeer {

SiteRegistry SiteRegistry::built_in() {
  SiteRegistry sites;
  sites.put("simulation", "the glasshouse of the mission's world, in this process",
            make_simulation_site);
  return sites;
}

Expected<void> SiteRegistry::add_with_manners(const std::string& name, const std::string& one_line,
                                              const Factory& factory, SiteManners manners) {
  auto added = add(name, one_line, factory);
  if (added) manners_[name] = std::move(manners);
  return added;
}

SiteManners SiteRegistry::manners(std::string_view name) const {
  const auto found = manners_.find(name);
  return found == manners_.end() ? SiteManners() : found->second;
}

Expected<std::unique_ptr<Site>> SiteRegistry::make(std::string_view name,
                                                   const SiteRequest& request) const {
  const auto factory = find(name);
  if (!factory) return tl::unexpected(factory.error());
  return (*factory)(request);
}

}  // namespace canopeer
