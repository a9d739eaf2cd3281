// redmap-three: reduction maps that `redmap export --to glsl` wrote, in three.js.
export { RedmapError } from './json_reader.js';
export type { RedmapManifest, RedmapParameter } from './manifest.js';
export type { RedmapExport } from './redmap_export.js';
export { RedmapLoader } from './redmap_loader.js';
export { RedmapMaterial, type RedmapMethod } from './redmap_material.js';
