#include "canopeer/run/site.h"

#include "canopeer/run/simulation_site.h"

namespace canopeer {

SiteRegistry SiteRegistry::built_in() {
  SiteRegistry sites;
  sites.put("simulation", "the glasshouse of the mission's world, in this process",
            make_simulation_site);
  return sites;
}

Expected<std::unique_ptr<Site>> SiteRegistry::make(std::string_view name,
                                                   const SiteRequest& request) const {
  const auto factory = find(name);
  if (!factory) return tl::unexpected(factory.error());
  return (*factory)(request);
}

}  // namespace canopeer
