#include "canopeer/import/world_source.h"

#include "canopeer/scene/scene_file.h"

namespace canopeer {

Expected<ImportedScene> build_world(const WorldSource& source, std::uint64_t seed,
                                    const ImportProgressCallback& progress) {
  ImportedScene result;
  if (!source.imported()) {
    result.scene = make_world(source.generated, seed);
    return result;
  }
  auto imported = !source.import.file.empty() ? import_world(source.import, progress)
                                              : place_scans(source.scans, progress);
  // A frozen scene keeps the seed it was grown with.
  if (imported && !is_frozen_scene(source.import.file)) imported->scene.seed = seed;
  return imported;
}

}  // namespace canopeer
