// Another process in the domain: tells what it is on /description (latched), and turns booleans
// round on service /turn, both until its standard input ends.

#include <unistd.h>

#include <cstdlib>

#include "canopeer/cdr/messages/std_msgs.h"
#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/dds/service.h"
#include "support/must.h"

int main(int argc, char** argv) {
  using namespace canopeer;
  if (argc != 3) return 2;
  ros::NodeOptions options;
  options.name = "peer";
  options.participant.domain = std::atoi(argv[1]);
  const auto node = must(ros::Node::make(options));
  const auto description =
      must(node->advertise<ros::std_msgs::String>("/description", ros::kLatchedQos));
  description.publish({argv[2]});
  using ros::std_srvs::SetBool;
  const auto server =
      must(ros::Server<SetBool>::make(*node, "/turn", [&](SetBool::Request&& request, auto reply) {
        reply({!request.data, argv[2]});
      }));
  char letter = 0;
  while (read(STDIN_FILENO, &letter, 1) > 0) {
  }
  return 0;
}
