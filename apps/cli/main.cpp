// redmap, the program: declares the subcommands, runs the one that was asked for, and turns whatever went wrong into
// one line on stderr. Exit status: 0 only if all that was asked for is on disk, 1 on any error, 130 when interrupted.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "base/nearest.h"
#include "commands.h"
#include "common.h"

namespace {

constexpr int kFailed = 1;
constexpr int kInterrupted = 130;  // 128 + SIGINT, as shells report it

/// Complaints take one line, whatever was in them.
int fail(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  fmt::print(stderr, "redmap: {}\n", message);
  return kFailed;
}

void add_commands(CLI::App& app) {
  using namespace redmap::cli;
  add_bake_command(app);
  add_render_command(app);
  add_view_command(app);
  add_compare_command(app);
  add_verify_command(app);
  add_inspect_command(app);
  add_export_command(app);
  add_bench_command(app);
  add_list_command(app);
  add_mesh_command(app);
  add_unwrap_command(app);
}

/// The deepest subcommand that was named, for "see redmap bake --help".
std::string command_line_so_far(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return app.get_name() + (chosen.empty() ? "" : " " + command_line_so_far(*chosen.front()));
}

/// What is wrong with the command line. CLI11 takes an unknown command for a missing one: say which it was.
std::string usage_complaint(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> extra = app.remaining();
  if (extra.empty() || !app.get_subcommands().empty())
    return fmt::format("{} (see {} --help)", error.what(), command_line_so_far(app));
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands(nullptr)) commands.push_back(command->get_name());
  return fmt::format("expected a command, found \"{}\" (did you mean \"{}\"? see redmap --help)", extra.front(),
                     redmap::nearest(extra.front(), commands));
}

int run(int argc, char** argv) {
  CLI::App app{"redmap: mip-maps for procedural shaders (Van Horn and Turk 2008)", "redmap"};
  app.set_version_flag("--version", "redmap " REDMAP_VERSION);
  app.require_subcommand(1);
  add_commands(app);
  // After the commands: they would inherit it.
  app.footer(
      "From a scene to a picture that does not alias:\n"
      "  redmap bake scenes/sphere_noise.toml\n"
      "  redmap render scenes/sphere_noise.toml -o sphere.png\n"
      "Every command explains itself with --help.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(usage_complaint(app, error));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  redmap::cli::catch_interrupts();
  try {
    return run(argc, argv);
  } catch (const redmap::cli::Interrupted&) {
    fmt::print(stderr, "interrupted\n");
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    return fail("out of memory");
  } catch (const std::exception& error) {
    if (!redmap::cli::interrupted()) return fail(error.what());
    fmt::print(stderr, "interrupted\n");
    return kInterrupted;
  }
}
