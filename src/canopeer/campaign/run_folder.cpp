#include "canopeer/campaign/run_folder.h"

#include <fmt/format.h>

#include <random>
#include <string>
#include <system_error>
#include <vector>

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// Everything that was left of runs of this name: those of processes that were killed, or that are
/// too late.
void remove_parts_of(const fs::path& dir) {
  const std::string begin = dir.filename().string() + ".";
  std::error_code code;
  std::vector<fs::path> parts;
  for (fs::directory_iterator it(dir.parent_path(), code), end; !code && it != end;
       it.increment(code)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with(begin) && name.ends_with(".part")) parts.push_back(it->path());
  }
  for (const auto& part : parts) fs::remove_all(part, code);
}

}  // namespace

// Where it lies tells processes apart, nothing else: the name may come from the system.
RunFolder::RunFolder(fs::path dir)
    : dir_(std::move(dir)),
      part_(dir_.string() + fmt::format(".{:08x}.part", std::random_device()())) {}

Expected<void> RunFolder::begin() const {
  std::error_code code;
  fs::create_directories(part_, code);
  if (code) return fail(part_.string() + ": cannot be made: " + code.message());
  return {};
}

Expected<void> RunFolder::finish() const {
  std::error_code code;
  fs::rename(part_, dir_, code);
  if (code) return fail(dir_.string() + ": cannot be made: " + code.message());
  remove_parts_of(dir_);
  return {};
}

void RunFolder::leave() const {
  const fs::path rest = dir_.string() + ".part";
  std::error_code code;
  fs::remove_all(rest, code);
  fs::rename(part_, rest, code);
}

void RunFolder::drop() const {
  std::error_code code;
  fs::remove_all(part_, code);
}

}  // namespace canopeer
