#pragma once

namespace canopeer::testing_support {

/// Moves this process and what it starts into a network of its own with nothing but loopback, up
/// and with multicast, so that tests side by side do not hear each other. Before any thread is
/// started. False: not allowed here (no root, no user namespaces); the network stays shared.
bool enter_own_network();

/// A DDS domain: 40 in a network of its own, else one by the process's number.
int own_domain();

}  // namespace canopeer::testing_support
