// A scene as the page of apps/web takes it: scene.json, and an export of every object.
#pragma once

#include "export/export_folder.h"
#include "view_options.h"

namespace redmap::cli {

/// Writes to `scene/` in `folder`. Maps that are not there, or of something else, are baked. Throws Error naming an
/// object that cannot be exported.
void write_web_scene(const ViewOptions& options, ExportFolder& folder);

}  // namespace redmap::cli
