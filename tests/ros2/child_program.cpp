#include "child_program.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace canopeer::testing_support {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void send_to(int descriptor, const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  dup2(file, descriptor);
  close(file);
}

}  // namespace

ChildProgram::ChildProgram(const std::vector<std::string>& arguments) {
  std::string name = (std::filesystem::temp_directory_path() / "canopeer_child_XXXXXX").string();
  folder_ = mkdtemp(name.data());
  std::vector<std::string> words = {CANOPEER_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  send_to(STDOUT_FILENO, folder_ / "out");
  send_to(STDERR_FILENO, folder_ / "err");
  if (chdir(CANOPEER_SOURCE_DIR) == 0) execv(argv[0], argv.data());
  _exit(127);
}

ChildProgram::~ChildProgram() {
  if (runs()) {
    send(SIGKILL);
    wait();
  }
  std::error_code code;
  std::filesystem::remove_all(folder_, code);
}

void ChildProgram::send(int signal) const { kill(pid_, signal); }

int ChildProgram::wait() {
  if (!ended_) waitpid(pid_, &status_, 0);
  ended_ = true;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
}

bool ChildProgram::runs() {
  if (!ended_) ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
  return !ended_;
}

std::string ChildProgram::out() const { return text_of(folder_ / "out"); }
std::string ChildProgram::err() const { return text_of(folder_ / "err"); }

}  // namespace canopeer::testing_support
