// `redmap bench paper`: the paper's figures measured anew, as text, JSON and one HTML page.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/atomic_file.h"
#include "base/parallel.h"
#include "commands.h"
#include "common.h"
#include "machine.h"
#include "paper/paper.h"
#include "paper/renderings.h"

namespace redmap::cli {

namespace {

struct Options {
  bench::PaperOptions measured;
  CommonOptions common;
  std::string html;
};

/// "Debian GNU/Linux 12 (bookworm), Linux 6.1.0".
std::string system_name() {
  std::string name = "unknown system";
  std::ifstream release("/etc/os-release");
  for (std::string line; std::getline(release, line);)
    if (line.starts_with("PRETTY_NAME=\"")) name = line.substr(13, line.size() - 14);
  utsname kernel{};
  if (uname(&kernel) == 0) name += fmt::format(", {} {}", kernel.sysname, kernel.release);
  return name;
}

/// GCC says only its number.
std::string compiler_name(const nlohmann::json& machine) {
  const auto name = machine["compiler"].get<std::string>();
  return name.find_first_not_of("0123456789.") == std::string::npos ? "GCC " + name : name;
}

bench::Origin origin_of(const bench::Report& report, const nlohmann::json& machine) {
  return {{"Processor", fmt::format("{}, {} cores, {} threads used", machine["processor"].get<std::string>(),
                                    machine["cores"].get<int>(), machine["threads"].get<int>())},
          {"Memory", fmt::format("{:.1f} GB", 1e-9 * machine["memory_bytes"].get<double>())},
          {"System", machine["system"].get<std::string>()},
          {"Versions", fmt::format("redmap {}, compiled by {}", REDMAP_VERSION, compiler_name(machine))},
          {"Run", fmt::format("{}, {} x {} texels, {:.0f} s, {:%Y-%m-%d %H:%M} UTC", report.quick ? "quick" : "full",
                              report.map_size, report.map_size, report.seconds, fmt::gmtime(std::time(nullptr)))}};
}

void run(Options& options) {
  const ThreadLimit threads(static_cast<std::size_t>(options.common.threads));
  std::optional<Progress> progress(std::in_place, "measuring");
  options.measured.progress = [&](double part, const std::string&) { progress->update(part); };
  options.measured.cancelled = interrupted;
  options.measured.figure_done = [&](const bench::Figure& figure) {
    progress->clear();
    fmt::print("{}\n", bench::text_of(figure));
    std::fflush(stdout);
  };
  const bench::Report report = bench::measure_paper(options.measured);
  progress.reset();
  nlohmann::json json = bench::json_of(report);
  json["machine"] = machine_json();
  json["machine"]["system"] = system_name();
  json["version"] = REDMAP_VERSION;
  write_json(options.common.json, json);
  if (!options.html.empty()) write_file(options.html, bench::html_of(report, origin_of(report, json["machine"])));
}

}  // namespace

void add_bench_paper(CLI::App& bench_app) {
  auto options = std::make_shared<Options>();
  bench::PaperOptions& measured = options->measured;
  CLI::App* sub = bench_app.add_subcommand("paper", "The paper's figures measured anew, beside its own");
  sub->add_flag("--quick", measured.quick, "fewer frames, samples and distances: under 3 minutes on two cores");
  sub->add_flag("--all-frames", measured.all_frames, "all 840 frames of Fig. 1");
  sub->add_option("--figures", measured.figures, "only these (all if not given)")
      ->delimiter(',')
      ->check(CLI::IsMember(bench::paper_figures()));
  sub->add_option("--size", measured.map_size, "Texels across a map; the paper's have 1024")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  sub->add_option("--object", measured.object, "in place of all meshes: sphere, cylinder, bunny or dragon");
  sub->add_option("--models", measured.models, "Folder of bunny_10k.obj and dragon_20k.obj")->capture_default_str();
  sub->add_option("--html", options->html, "also write one page with tables, plots and pictures here")
      ->type_name("FILE");
  add_device_option(*sub, measured.device);
  add_common_options(*sub, options->common);
  sub->footer("Example: redmap bench paper --quick --json paper.json --html paper.html");
  sub->callback([options] { run(*options); });
}

}  // namespace redmap::cli
