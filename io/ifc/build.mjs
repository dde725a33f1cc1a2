// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Bundles src/ into build/ifc: import-ifc.cjs, web-ifc's WebAssembly beside it, and web-ifc's licence.
import { copyFileSync, mkdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const target = join(here, '..', '..', 'build', 'ifc');
const webIfc = join(here, 'node_modules', 'web-ifc');
const { version } = JSON.parse(readFileSync(join(webIfc, 'package.json'), 'utf8'));

// web-ifc's script is 5.9 MB of classes for the lines of every schema, around the 160 kB that run its WebAssembly. The
// importer reads lines by the places of their attributes and takes the latter alone: loading takes 0.03 s, not 0.6.
const webIfcModule = {
  name: 'web-ifc-module',
  setup(bundler) {
    bundler.onResolve({ filter: /^web-ifc-module$/ }, () => ({ path: 'web-ifc-module', namespace: 'web-ifc' }));
    bundler.onLoad({ filter: /.*/, namespace: 'web-ifc' }, () => {
      const script = readFileSync(join(webIfc, 'web-ifc-api-node.js'), 'utf8');
      const head = '"dist/web-ifc-node.js"(exports2, module2) {\n';
      const start = script.indexOf(head);
      const end = script.indexOf('\n  }\n});', start);
      if (start < 0 || end < 0) throw new Error(`web-ifc ${version} is not laid out as expected`);
      const body = script.slice(start + head.length, end);
      return { contents: `const module2 = module, exports2 = exports;\n${body}`, loader: 'js', resolveDir: webIfc };
    });
  },
};

mkdirSync(target, { recursive: true });
await build({
  entryPoints: [join(here, 'src', 'main.mjs')],
  absWorkingDir: here,
  outfile: join(target, 'import-ifc.cjs'),
  bundle: true,
  minify: true,
  platform: 'node',
  target: 'node18',
  format: 'cjs',
  charset: 'utf8',
  legalComments: 'none',
  logLevel: 'warning',
  banner: {
    js: `// Part of impinge (MIT). Contains web-ifc ${version} (MPL-2.0, see web-ifc-license.md; source: https://github.com/ThatOpen/engine_web-ifc)`,
  },
  plugins: [webIfcModule],
});
copyFileSync(join(webIfc, 'web-ifc-node.wasm'), join(target, 'web-ifc-node.wasm'));
copyFileSync(join(webIfc, 'LICENSE.md'), join(target, 'web-ifc-license.md'));
console.log('build/ifc: import-ifc.cjs, web-ifc-node.wasm, web-ifc-license.md');
