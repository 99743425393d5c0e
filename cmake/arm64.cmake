# For 64 bit Arm, compiled on another Debian machine with the libraries of both beside one another (multiarch).
# scripts/in_debian.sh RELEASE arm64 COMMAND uses it. Tests run under qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/bin/qemu-aarch64)
# Tools of this machine's bring libraries of their own (OpenSSL, say), which pkg-config would name.
set(CMAKE_IGNORE_PATH /usr/lib/x86_64-linux-gnu)
