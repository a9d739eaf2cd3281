// Reads back what `redmap export --to gltf` or `--to ktx2` wrote: every .gltf through Khronos' validator, every .ktx2
// through ktx-parse. usage: node read_back.mjs TOOLS FOLDER (TOOLS: where install_tools.sh put its packages)
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [tools, folder] = process.argv.slice(2);
const require = createRequire(join(resolve(tools), 'package.json'));
const validator = require('gltf-validator');
const { read } = await import(pathToFileURL(require.resolve('ktx-parse').replace('.cjs', '.modern.js')).href).catch(
    () => require('ktx-parse'));

function fail(what) {
  console.log(`${folder}: ${what}`);
  process.exitCode = 1;
}

async function checkGltf(name) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(join(folder, name))), {
    externalResourceFunction: async uri => new Uint8Array(readFileSync(join(folder, uri))),
  });
  const { numErrors, numWarnings, messages } = report.issues;
  if (numErrors + numWarnings > 0) fail(`${name}: ${JSON.stringify(messages.filter(m => m.severity < 2), null, 1)}`);
  else console.log(`${name}: valid, ${report.info.totalTriangleCount} triangles, ${report.info.materialCount} materials`);
}

function checkKtx2(name) {
  const texture = read(new Uint8Array(readFileSync(join(folder, name))));
  const levels = 1 + Math.floor(Math.log2(Math.max(texture.pixelWidth, texture.pixelHeight)));
  if (texture.levels.length !== levels) fail(`${name}: expected ${levels} levels, found ${texture.levels.length}`);
  const channels = texture.dataFormatDescriptor[0].samples.length;
  texture.levels.forEach((level, i) => {
    const texels = Math.max(1, texture.pixelWidth >> i) * Math.max(1, texture.pixelHeight >> i);
    const expected = texels * Math.max(1, texture.layerCount) * channels;
    if (level.levelData.byteLength !== expected)
      fail(`${name}: level ${i}: expected ${expected} bytes, found ${level.levelData.byteLength}`);
  });
  const size = `${texture.pixelWidth}x${texture.pixelHeight}`;
  console.log(`${name}: format ${texture.vkFormat}, ${size}, ${Math.max(1, texture.layerCount)} layers, ${levels} levels`);
}

for (const name of readdirSync(folder)) {
  if (name.endsWith('.gltf')) await checkGltf(name);
  if (name.endsWith('.ktx2')) checkKtx2(name);
}
