// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Bundles src/ into one file, build/page/report.html: the template in which the line of kMarker is replaced by the data.
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const kMarker = '<!-- impinge: data -->';
const here = dirname(fileURLToPath(import.meta.url));
const target = join(here, '..', 'build', 'page', 'report.html');

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(here, 'src', entry)],
    absWorkingDir: here,
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['chrome109', 'firefox115', 'safari16.4'],
    charset: 'utf8',
    legalComments: 'none',
    logLevel: 'warning',
  });
  return result.outputFiles[0].text;
}

const hashOf = (text) => `'sha256-${createHash('sha256').update(text, 'utf8').digest('base64')}'`;

const program = await bundle('main.ts');
const style = await bundle('style.css');
if (program.includes(kMarker) || /<\/script|<!--/i.test(program) || /<\/style/i.test(style)) {
  throw new Error('the bundle holds a sequence that would end its own element');
}
const page = readFileSync(join(here, 'src', 'index.html'), 'utf8')
  .replace('{{policy}}', () => `script-src ${hashOf(program)}; style-src ${hashOf(style)}`)
  .replace('{{style}}', () => style)
  .replace('{{program}}', () => program);
if (page.split(kMarker).length !== 2) throw new Error(`the template must hold ${kMarker} exactly once`);

mkdirSync(dirname(target), { recursive: true });
writeFileSync(`${target}.new`, page);
renameSync(`${target}.new`, target);
console.log(`build/page/report.html: ${(Buffer.byteLength(page) / 1024).toFixed(0)} KiB`);
