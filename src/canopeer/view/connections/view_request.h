#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <memory>

#include "canopeer/view/connections/view_reader.h"

namespace canopeer {

/// Takes a reader in, and gives what tells all of them.
using AdoptReader = std::function<ViewReader::Tell(const std::shared_ptr<ViewReader>&)>;

/// Answers one request and closes, or turns it into a reader. In the server's thread.
void answer_request(boost::asio::ip::tcp::socket&& socket, ViewShared& shared, AdoptReader adopt);

}  // namespace canopeer
