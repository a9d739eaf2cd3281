// The viewer page: relative paths, so that it works from any folder of any server.
import { defineConfig } from 'vite';

export default defineConfig({
  base: './',
  build: { outDir: 'page', assetsDir: 'viewer', target: 'es2022', chunkSizeWarningLimit: 1000 },
});
