// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// node io/ifc/time.mjs FILE.ifc...: the CPU seconds that web-ifc takes to draw each file and the importer to read it, the
// least of three runs of each in turn, their programs' starts included.
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const kRuns = 3;
const self = fileURLToPath(import.meta.url);

async function draw(file) {
  const { IfcAPI } = await import('web-ifc');
  const api = new IfcAPI();
  await api.Init();
  const model = api.OpenModel(readFileSync(file), { CIRCLE_SEGMENTS: 49 });
  const seen = new Set();
  api.StreamAllMeshes(model, ({ geometries }) => {
    for (let i = 0; i < geometries.size(); ++i) {
      const { geometryExpressID } = geometries.get(i);
      if (seen.has(geometryExpressID)) continue;
      seen.add(geometryExpressID);
      const geometry = api.GetGeometry(model, geometryExpressID);
      api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
      api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize());
      geometry.delete();
    }
  });
}

const kTellUsage = `process.on('exit', () => {
  const { user, system } = process.cpuUsage();
  process.stderr.write(String((user + system) / 1e6));
})`;

function secondsOf(program, file) {
  const { status, stderr } = spawnSync(
    process.execPath,
    ['--import', `data:text/javascript,${encodeURIComponent(kTellUsage)}`, ...program, file],
    { stdio: ['ignore', 'ignore', 'pipe'], encoding: 'utf8' },
  );
  const seconds = Number(/[0-9.]+$/.exec(stderr)?.[0]);
  if (status !== 0 || !(seconds > 0)) throw new Error(`${file}: ${stderr}`);
  return seconds;
}

if (process.argv[2] === '--draw') {
  await draw(process.argv[3]);
} else {
  const importer = fileURLToPath(new URL('../../build/ifc/import-ifc.cjs', import.meta.url));
  for (const file of process.argv.slice(2)) {
    let [drawn, read] = [Infinity, Infinity];
    for (let run = 0; run < kRuns; ++run) {
      drawn = Math.min(drawn, secondsOf([self, '--draw'], file));
      read = Math.min(read, secondsOf([importer], file));
    }
    console.log(`${file}: web-ifc ${drawn.toFixed(2)} s, importer ${read.toFixed(2)} s, ${(read / drawn).toFixed(2)}`);
  }
}
