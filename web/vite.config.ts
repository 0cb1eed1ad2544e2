import { svelte } from '@sveltejs/vite-plugin-svelte';
import { svelteTesting } from '@testing-library/svelte/vite';
import { defineConfig } from 'vitest/config';

// `npm run dev` beside a running station: its API is reached through Vite, without the page's origin, which it would refuse.
const station = 'http://127.0.0.1:8080';

export default defineConfig({
  plugins: [svelte()],
  build: { target: 'es2022', chunkSizeWarningLimit: 1500 },
  server: {
    proxy: {
      '/api': {
        target: station,
        ws: true,
        changeOrigin: true,
        configure: (proxy) => {
          proxy.on('proxyReq', (request) => request.removeHeader('origin'));
          proxy.on('proxyReqWs', (request) => request.removeHeader('origin'));
        },
      },
    },
  },
  test: {
    projects: [
      {
        extends: true,
        test: { name: 'logic', include: ['src/**/*.test.ts'], exclude: ['src/**/*.svelte.test.ts'], environment: 'node' },
      },
      {
        extends: true,
        plugins: [svelteTesting()],
        test: { name: 'components', include: ['src/**/*.svelte.test.ts'], environment: 'jsdom', setupFiles: 'src/testing/set_up.ts' },
      },
    ],
  },
});
