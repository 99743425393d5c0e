#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "source_tree.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// scripts/install_packages.sh on a machine that does not exist: its package tools are stand-ins
/// that write down what they are asked for.
class Machine {
 public:
  /// Lists of packages, each name between blanks; installed ones of another architecture, or of
  /// all, with it.
  Machine(const std::string& packages_file, std::string installed, std::string in_release)
      : installed_(std::move(installed)), in_release_(std::move(in_release)) {
    std::string name =
        (fs::temp_directory_path() / "canopeer_packages_").string() + std::string(6, 'X');
    root_ = mkdtemp(name.data());
    fs::create_directories(root_ / "scripts");
    fs::create_directories(root_ / "tools");
    fs::copy_file(testing_support::source_root() / "scripts/install_packages.sh",
                  root_ / "scripts/install_packages.sh");
    EXPECT_TRUE(write_file(root_ / "packages.txt", packages_file).has_value());
    add_tool("dpkg-query",
             "for name; do for arch in '' :arm64 :all; do case \" $INSTALLED \" in *\" "
             "${name%:*}$arch \"*) echo \"${name%:*}${arch:-:amd64} install ok installed\";; esac; "
             "done; done");
    add_tool(
        "apt-cache",
        "echo policy >>asked; case \" $IN_RELEASE \" in *\" $2 \"*) printf '%s:\\n  Installed: "
        "(none)\\n  Candidate: 1.0\\n' \"$2\";; esac");
    add_tool("apt-get",
             "echo \"$@\" | sed 's/-y -qq --no-install-recommends //' >>asked; [ -z \"$FAILS\" ]");
    add_tool("id", "echo 0");
  }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;
  ~Machine() {
    std::error_code code;
    fs::remove_all(root_, code);
  }

  /// What the script asked apt for, and its exit status. `arch`: of the machine to compile for;
  /// `word`: the script's argument.
  std::string run(bool apt_fails = false, const std::string& arch = "",
                  const std::string& word = "") {
    fs::remove(root_ / "asked");
    const std::string command =
        "cd '" + root_.string() + "' && PATH=\"$PWD/tools:$PATH\" DEB_HOST_ARCH=" + arch +
        " FAILS=" + (apt_fails ? "1" : "") + " INSTALLED='" + installed_ + "' IN_RELEASE='" +
        in_release_ + "' bash scripts/install_packages.sh " + word + " >said 2>&1";
    const int status = std::system(command.c_str());
    std::string asked = read_file(root_ / "asked").value_or("");
    for (auto at = asked.find("policy\n"); at != std::string::npos; at = asked.find("policy\n")) {
      asked.erase(at, 7);
      looked_up_ = true;
    }
    return asked + (status == 0 ? "" : "failed");
  }
  [[nodiscard]] std::string said() const { return read_file(root_ / "said").value_or(""); }
  [[nodiscard]] bool looked_up() const { return looked_up_; }

 private:
  void add_tool(const std::string& name, const std::string& body) const {
    const fs::path path = root_ / "tools" / name;
    EXPECT_TRUE(write_file(path, "#!/usr/bin/env bash\n" + body + "\n").has_value());
    fs::permissions(path, fs::perms::owner_all);
  }

  std::string installed_;
  std::string in_release_;
  fs::path root_;
  bool looked_up_ = false;
};

const std::string kPackages = "# some\ng++  # a tool\nnew|old\n\noracle?\nthis|that?\n";

TEST(InstallPackages, NothingMissingIsQuickAndSilent) {
  Machine machine(kPackages, "g++ old oracle that", "");
  EXPECT_EQ(machine.run(), "");
  EXPECT_EQ(machine.said(), "");
  EXPECT_FALSE(machine.looked_up());
}

TEST(InstallPackages, TheFirstThatTheReleaseHasIsTaken) {
  EXPECT_EQ(Machine(kPackages, "", "g++ new old oracle this that").run(),
            "update -qq\ninstall g++ new oracle this\n");
  EXPECT_EQ(Machine(kPackages, "", "g++ old that").run(), "update -qq\ninstall g++ old that\n");
}

TEST(InstallPackages, WhatTheReleaseLacksForGoodCostsNoUpdate) {
  Machine machine(kPackages, "g++ new", "g++ new");
  EXPECT_EQ(machine.run(), "");
  EXPECT_EQ(machine.said(), "");
  EXPECT_TRUE(machine.looked_up());
}

TEST(InstallPackages, WithoutTheOptionalOnesItGoesOn) {
  Machine machine(kPackages, "g++ new that", "oracle");
  EXPECT_EQ(machine.run(), "install oracle\n");
  EXPECT_EQ(machine.run(true), "install oracle\n");
  EXPECT_NE(machine.said().find("left out"), std::string::npos) << machine.said();
}

TEST(InstallPackages, WithoutTheOthersItDoesNot) {
  Machine lacks(kPackages, "g++", "g++ oracle");
  EXPECT_EQ(lacks.run(), "update -qq\nfailed");
  EXPECT_NE(lacks.said().find("no package new|old"), std::string::npos) << lacks.said();
  Machine offline(kPackages, "g++", "g++ new oracle");
  EXPECT_EQ(offline.run(true), "update -qq\nfailed");
}

TEST(InstallPackages, ForAnotherMachineLibrariesAreThatMachines) {
  Machine machine("g++\nlibnew-dev|libold-dev\nlibforall-dev\nliboracle?\n", "",
                  "g++ libold-dev libold-dev:arm64 libforall-dev g++-aarch64-linux-gnu qemu-user");
  EXPECT_EQ(machine.run(false, "arm64"),
            "update -qq\ninstall g++ libold-dev:arm64 libforall-dev g++-aarch64-linux-gnu "
            "qemu-user\n");
}

TEST(InstallPackages, ALibraryOfThisMachineIsNoneOfAnother) {
  const std::string packages = "g++\nliba-dev\nlibb-dev\nlibforall-dev\n";
  Machine machine(packages,
                  "g++ liba-dev libb-dev libb-dev:arm64 libforall-dev:all qemu-user "
                  "g++-aarch64-linux-gnu",
                  "liba-dev:arm64");
  EXPECT_EQ(machine.run(false, "arm64"), "update -qq\ninstall liba-dev:arm64\n");
  EXPECT_EQ(machine.run(), "");
}

TEST(InstallPackages, TheDemoTakesNoMoreThanItNeeds) {
  Machine bare(read_file(testing_support::source_root() / "packages.txt").value(), "", "");
  EXPECT_EQ(bare.run(false, "", "demo"), "update -qq\nfailed");
  EXPECT_NE(bare.said().find("no package g++"), std::string::npos) << bare.said();
  const std::string packages = "g++\nliba-dev\n# ---- Beyond the demo ----\nlibb-dev\noracle?\n";
  const std::string release = "g++ liba-dev libb-dev oracle";
  EXPECT_EQ(Machine(packages, "", release).run(false, "", "demo"),
            "update -qq\ninstall g++ liba-dev\n");
  EXPECT_EQ(Machine(packages, "g++ liba-dev", release).run(false, "", "release"),
            "update -qq\ninstall libb-dev oracle\n");
}

}  // namespace
}  // namespace canopeer
