#include <CLI/CLI.hpp>

#include "mission_arguments.h"
#include "options.h"

namespace canopeer::app {
namespace {

/// What every campaign takes.
void add_campaign(CLI::App& command, CampaignArguments& a) {
  command.add_option("--set", a.settings, "Override a setting in all runs (repeatable)")
      ->expected(1)
      ->take_all();
  command.add_option("--jobs", a.jobs, "Runs at a time, each a process")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_option("--threads", a.threads, "Threads of each run (0: the cores shared out)")
      ->check(CLI::Range(0, 1024));
  command.add_option("--shard", a.shard,
                     "i/n: make every n-th run only, from the i-th (several machines, one folder)");
  command.add_option("--out", a.out, "Folder of the runs and of what comes of them");
  command.add_flag("--report-only", a.report_only, "Take the runs that are there; make none");
  command.add_flag("--quiet", a.quiet, "Print errors only");
}

void add_suite(CLI::App& bench, SuiteArguments& a) {
  CLI::App* command = bench.add_subcommand(
      "suite",
      "Run planners on CanopeerBench, 24 frozen worlds; write one page, one file to hand in");
  command->add_option("--planners", a.planners, "Planners, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--split", a.split, "Which worlds: train, validation, test or all")
      ->check(CLI::IsMember({"train", "validation", "test", "all"}))
      ->capture_default_str();
  command->add_option("--worlds", a.worlds, "Only these, separated by commas")->delimiter(',');
  command->add_option("--protocols", a.protocols, "Rules of the runs, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--seeds", a.seeds, "Runs per planner and world: seeds 1 to N")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  add_campaign(*command, a);
  command->add_option("--check", a.check,
                      "Say whether a results.json is a valid entry; run nothing");
  command->callback([&a] { bench_suite(a); });
}

}  // namespace

void add_bench(CLI::App& app, BenchArguments& a, SuiteArguments& suite, VerifyArguments& verify) {
  CLI::App* command = app.add_subcommand(
      "bench",
      "Compare planners on the same worlds and seeds; the same command goes on after a kill");
  command->add_option("missions", a.missions, "Mission files (YAML), or names of shipped ones");
  command
      ->add_option("--planners", a.planners,
                   "Planners, each as NAME or NAME@COMPUTE-TABLE, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--runs", a.runs, "Seeds per planner and mission")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--first-seed", a.first_seed, "The first of them")->capture_default_str();
  command
      ->add_option("--budgets", a.budgets_s,
                   "Seconds per segment, separated by commas; each is a run of its own")
      ->delimiter(',')
      ->check(CLI::Range(1.0, 36000.0));
  command
      ->add_option("--protocols,--protocol", a.protocols,
                   "Rules by name, separated by commas, each a comparison of its own: tight, " +
                       protocol_list())
      ->delimiter(',');
  command->add_option("--yardsticks", a.yardsticks,
                      "Folder of yardsticks (MISSION/seed_N/PROTOCOL.json) to hold runs against");
  command->add_option("--segments", a.segments, "Only the first K segments")
      ->check(CLI::Range(1, 100000));
  add_campaign(*command, a);
  command
      ->add_option("--merge", a.merge,
                   "Join the runs of this folder, made by the same command on another machine, "
                   "into --out; make none (repeatable)")
      ->expected(1)
      ->take_all()
      ->excludes("--shard");
  command->add_flag("--keep-maps", a.keep_maps, "Keep each run's maps and pictures");
  CLI::Option* records =
      command->add_option("--verify-records", verify.records,
                          "Run every best known result again and compare (default: records/)");
  records->expected(0, 1);
  add_suite(*command, suite);
  command->callback([&a, &verify, command, records] {
    if (!command->get_subcommands().empty()) return;
    if (records->count() > 0) {
      verify.out = a.out;
      verify.jobs = a.jobs;
      return verify_records(verify);
    }
    if (a.missions.empty()) throw CLI::RequiredError("missions");
    if (a.out.empty()) throw CLI::RequiredError("--out");
    bench(a);
  });
}

void add_bound(CLI::App& app, BoundArguments& a) {
  CLI::App* command = app.add_subcommand(
      "bound",
      "Say how good a run of a mission could be: what can be seen at all, the best plan of one who "
      "knows the world, and bounds; the same command goes on after a stop");
  add_mission(*command, a.mission);
  command->add_option("--protocol", a.protocol, "Rules by name (default: the mission's own)");
  command->add_option("--out", a.out, "Directory for the results")->required();
  command->add_option("--pool", a.pool,
                      "File of the sampled views, used again where it fits (default: views.pool in "
                      "--out); it does not depend on the protocol");
  command->add_option("--record", a.record,
                      "Record to put the results into, e.g. records/dense_1/seed_1/tight10.json; "
                      "better ones that are there stay");
  command->add_option("--segments", a.segments, "Only the first K segments")
      ->check(CLI::Range(1, 100000));
  command
      ->add_option("--views-per-fruit", a.views_per_fruit,
                   "Sampled views aimed at each fruit in range, at least")
      ->check(CLI::Range(0, 1000000));
  command->add_option("--views-per-segment", a.most_views, "Sampled views a segment, at most")
      ->check(CLI::Range(1, 100000000));
  command
      ->add_option("--find-area", a.min_area_cm2,
                   "A fruit may count as found when so many cm2 of it have been seen")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_flag("!--no-pipeline", a.pipeline,
                    "Do not feed the frames of a set cover to the fruit map");
  command->add_flag("!--no-plans", a.plans, "No plans of one who knows the world");
  command->add_option("--threads", a.threads, "Threads at most (0: all cores)")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--quiet", a.quiet, "Print errors only");
  command->callback([&a] { bound(a); });
}

}  // namespace canopeer::app
