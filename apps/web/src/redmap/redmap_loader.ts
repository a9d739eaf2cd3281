// Loads what `redmap export --to glsl` wrote: the folder's manifest, then all files at once.
import { Loader, type LoadingManager } from 'three';
import { RedmapError } from './json_reader.js';
import { readManifest, type RedmapFile } from './manifest.js';
import { makeExport, type RedmapExport } from './redmap_export.js';

async function fetched(url: string, headers: HeadersInit): Promise<Response> {
  const response = await fetch(url, { headers }).catch(() => {
    throw new RedmapError(`${url}: expected a file of an export, found no answer`);
  });
  if (!response.ok) throw new RedmapError(`${url}: expected a file of an export, found status ${response.status}`);
  return response;
}

/** The bytes of a response, unpacked if need be. */
async function bytesOf(response: Response, url: string, onBytes: (count: number) => void): Promise<ArrayBuffer> {
  const counted = new TransformStream<Uint8Array, Uint8Array<ArrayBuffer>>({
    transform(chunk, controller) {
      onBytes(chunk.byteLength);
      controller.enqueue(chunk as Uint8Array<ArrayBuffer>);
    },
  });
  let stream: ReadableStream<Uint8Array> = response.body!.pipeThrough(counted);
  // A server may have unpacked it on the way: then it says so.
  if (url.endsWith('.gz') && response.headers.get('Content-Encoding') !== 'gzip')
    stream = stream.pipeThrough(new DecompressionStream('gzip') as never);
  return new Response(stream as ReadableStream<Uint8Array<ArrayBuffer>>).arrayBuffer().catch(error => {
    throw new RedmapError(`${url}: expected a whole file, found: ${String(error)}`);
  });
}

/** `loader.loadAsync('exports/bunny/')`. Progress is in bytes, as transferred; errors are RedmapErrors. */
export class RedmapLoader extends Loader<RedmapExport, string> {
  constructor(manager?: LoadingManager) {
    super(manager);
  }

  override load(
    folder: string,
    onLoad: (result: RedmapExport) => void,
    onProgress?: (event: ProgressEvent) => void,
    onError?: (error: unknown) => void,
  ): void {
    this.manager.itemStart(folder);
    this.#loaded(folder, onProgress)
      .then(onLoad, error => {
        this.manager.itemError(folder);
        if (!onError) throw error;
        onError(error);
      })
      .finally(() => this.manager.itemEnd(folder));
  }

  async #loaded(folder: string, onProgress?: (event: ProgressEvent) => void): Promise<RedmapExport> {
    const base = this.manager.resolveURL(this.path + (folder.endsWith('/') ? folder : `${folder}/`));
    const manifestUrl = `${base}manifest.json`;
    const document: unknown = await (await fetched(manifestUrl, this.requestHeader)).json().catch(() => {
      throw new RedmapError(`${manifestUrl}: expected JSON, found something else`);
    });
    const manifest = readManifest(document, manifestUrl);
    let loaded = 0;
    let total = 0;
    const get = async ({ file, gzip }: RedmapFile): Promise<ArrayBuffer> => {
      const url = base + (gzip ?? file);
      const response = await fetched(url, this.requestHeader);
      total += Number(response.headers.get('Content-Length') ?? 0);
      return bytesOf(response, url, count => {
        loaded += count;
        onProgress?.(new ProgressEvent('progress', { lengthComputable: total >= loaded, loaded, total }));
      });
    };
    const [include, weights, words, mesh] = await Promise.all([
      get(manifest.include),
      get(manifest.weights),
      get(manifest.words),
      get(manifest.mesh),
    ]);
    return makeExport(manifest, { include, weights, words, mesh });
  }
}
