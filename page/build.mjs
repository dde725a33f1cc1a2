// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Bundles src/ into one file, build/page/report.html: the template in which the line of kMarker is replaced by the data.
// At its end stand the licences of the packages that went into it.
import { createHash } from 'node:crypto';
import { mkdirSync, readdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const kMarker = '<!-- impinge: data -->';
const here = dirname(fileURLToPath(import.meta.url));
const target = join(here, '..', 'build', 'page', 'report.html');

const packages = new Set();

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(here, 'src', entry)],
    absWorkingDir: here,
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    format: 'iife',
    target: ['chrome109', 'firefox115', 'safari16.4'],
    charset: 'utf8',
    legalComments: 'none',
    logLevel: 'warning',
  });
  for (const file of Object.keys(result.metafile.inputs)) {
    const name = /(?:^|\/)node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(file)?.[1];
    if (name) packages.add(name);
  }
  return result.outputFiles[0].text;
}

function licenceOf(name) {
  const folder = join(here, 'node_modules', name);
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${name} has no licence`);
  const { version } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const text = readFileSync(join(folder, file), 'utf8').trim();
  if (text.includes('--')) throw new Error(`the licence of ${name} would end its comment`);
  return `<!--\nThis page contains ${name} ${version}:\n\n${text}\n-->`;
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
  .replace('{{program}}', () => program)
  .replace('{{licences}}', () => [...packages].sort().map(licenceOf).join('\n'));
if (page.split(kMarker).length !== 2) throw new Error(`the template must hold ${kMarker} exactly once`);

mkdirSync(dirname(target), { recursive: true });
writeFileSync(`${target}.new`, page);
renameSync(`${target}.new`, target);
console.log(`build/page/report.html: ${(Buffer.byteLength(page) / 1024).toFixed(0)} KiB`);
