// The subcommands of `redmap`, one file each. Each function declares its flags and what runs when it was chosen; the
// run throws redmap::Error, or returns only when all that was asked for is on disk.
#pragma once

#include <CLI/CLI.hpp>

namespace redmap::cli {

void add_bake_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_verify_command(CLI::App& app);
void add_inspect_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_bench_command(CLI::App& app);
void add_bench_strip(CLI::App& bench_app);
void add_bench_atlas(CLI::App& bench_app);
void add_bench_shading_normals(CLI::App& bench_app);
void add_bench_normals(CLI::App& bench_app);
void add_bench_coverage(CLI::App& bench_app);
void add_bench_gpu(CLI::App& bench_app);
void add_bench_export(CLI::App& bench_app);
void add_bench_paper(CLI::App& bench_app);
void add_list_command(CLI::App& app);
void add_view_command(CLI::App& app);
void add_mesh_command(CLI::App& app);
void add_unwrap_command(CLI::App& app);

}  // namespace redmap::cli
