// RMSE between a picture of an object (PFM) and its reference (TIFF of floats, not compressed, as oiiotool writes it), over
// pixels that neither sees background in nor has it beside them. Background is negative, or the three numbers given.
// usage: node compare_pictures.mjs PICTURE.pfm REFERENCE.tif MOST R G B. Fails above MOST, and without pixels to compare.
import { readFileSync } from 'node:fs';

function pixels(width, height, data, upwards) {
  return { width, height, at: (x, y) => {
    const first = 3 * ((upwards ? height - 1 - y : y) * width + x);
    return data.subarray(first, first + 3);
  } };
}

function readPfm(path) {
  const bytes = readFileSync(path);
  const header = bytes.toString('latin1', 0, 64).match(/^PF\s(\d+) (\d+)\s(-?[\d.]+)\s/);
  if (!header || Number(header[3]) >= 0) throw new Error(`${path}: expected a little-endian PFM picture`);
  const data = new Float32Array(bytes.buffer.slice(bytes.byteOffset + header[0].length));
  return pixels(Number(header[1]), Number(header[2]), data, true);
}

function readTiff(path) {
  const bytes = readFileSync(path), directory = bytes.readUInt32LE(4), tags = new Map();
  for (let i = 0; i < bytes.readUInt16LE(directory); i++) {
    const entry = directory + 2 + 12 * i, isShort = bytes.readUInt16LE(entry + 2) === 3;
    const count = bytes.readUInt32LE(entry + 4);
    const at = count * (isShort ? 2 : 4) > 4 ? bytes.readUInt32LE(entry + 8) : entry + 8;
    tags.set(bytes.readUInt16LE(entry), isShort ? bytes.readUInt16LE(at) : bytes.readUInt32LE(at));
  }
  // Strips that are not compressed follow one another.
  const [width, height, first] = [256, 257, 273].map(tag => tags.get(tag));
  if (tags.get(259) !== 1) throw new Error(`${path}: expected a TIFF picture that is not compressed`);
  return pixels(width, height, new Float32Array(bytes.buffer.slice(bytes.byteOffset + first)), false);
}

const picture = readPfm(process.argv[2]), reference = readTiff(process.argv[3]);
const most = Number(process.argv[4]), background = process.argv.slice(5, 8).map(Number);
const isBackground = c => c[0] < 0 || (background.length === 3 && background.every((b, i) => Math.abs(c[i] - b) < 1e-6));
let sum = 0, count = 0;
for (let y = 1; y + 1 < picture.height; y++)
  for (let x = 1; x + 1 < picture.width; x++) {
    let inside = true;
    for (let j = -1; j <= 1; j++)
      for (let i = -1; i <= 1; i++)
        inside &&= !isBackground(picture.at(x + i, y + j)) && !isBackground(reference.at(x + i, y + j));
    if (!inside) continue;
    const a = picture.at(x, y), b = reference.at(x, y);
    for (let c = 0; c < 3; c++) sum += (a[c] - b[c]) ** 2 / 3;
    count++;
  }
const rmse = Math.sqrt(sum / count);
console.log(`RMSE ${rmse.toFixed(5)} over ${count} pixels`);
process.exit(count > 100 && rmse <= most ? 0 : 1);
