// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// From the text of the geometry block to meshes: base64, inflated as it streams, in steps that leave the page responsive.
import { BlockError, type SceneBlock } from './data';

export interface RawMesh {
  positions: Float32Array;
  corners: Uint32Array;
}

/** Gives the browser a chance to draw and to answer, if the last one is a frame ago. */
export class Breather {
  private last = performance.now();
  async breathe(): Promise<void> {
    if (performance.now() - this.last < 12) return;
    await new Promise((resume) => setTimeout(resume));
    this.last = performance.now();
  }
}

const kPiece = 1 << 18; // a multiple of four: base64 digits come in fours

async function* bytesOf(text: string): AsyncGenerator<Uint8Array<ArrayBuffer>> {
  const breather = new Breather();
  for (let at = 0; at < text.length; at += kPiece) {
    const piece = atob(text.slice(at, at + kPiece));
    const bytes = new Uint8Array(piece.length);
    for (let i = 0; i < piece.length; ++i) bytes[i] = piece.charCodeAt(i);
    yield bytes;
    await breather.breathe();
  }
}

async function inflate(text: string, size: number): Promise<Uint8Array> {
  const stream = new DecompressionStream('deflate');
  const writer = stream.writable.getWriter();
  const feed = (async () => {
    for await (const bytes of bytesOf(text)) await writer.write(bytes);
    await writer.close();
  })();
  feed.catch((error: unknown) => void writer.abort(error).catch(() => undefined));
  const all = new Uint8Array(size);
  const reader = stream.readable.getReader();
  let at = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    if (at + value.length > size) throw new Error('too long');
    all.set(value, at);
    at += value.length;
  }
  await feed;
  if (at !== size) throw new Error('too short');
  return all;
}

/** The meshes of the scene in order; rejects with a BlockError if the text does not hold what the scene announces. */
export async function readMeshes(text: string, scene: SceneBlock): Promise<RawMesh[]> {
  const size = scene.meshes.reduce((sum, mesh) => sum + 12 * (mesh.vertices + mesh.triangles), 0);
  let bytes: Uint8Array;
  try {
    bytes = await inflate(text.replace(/\s+/g, ''), size);
  } catch {
    throw new BlockError('The 3D geometry cannot be read: its block is damaged, or was cut short.');
  }
  let at = bytes.byteOffset;
  return scene.meshes.map((mesh, i) => {
    const positions = new Float32Array(bytes.buffer, at, 3 * mesh.vertices);
    at += positions.byteLength;
    const corners = new Uint32Array(bytes.buffer, at, 3 * mesh.triangles);
    at += corners.byteLength;
    for (const corner of corners) {
      if (corner >= mesh.vertices) throw new BlockError(`The 3D geometry cannot be read: mesh ${i} names no vertex.`);
    }
    return { positions, corners };
  });
}
