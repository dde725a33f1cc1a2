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

function bytesOf(text: string): ReadableStream<Uint8Array<ArrayBuffer>> {
  const breather = new Breather();
  let at = 0;
  return new ReadableStream({
    async pull(controller) {
      await breather.breathe();
      const piece = atob(text.slice(at, (at += kPiece)));
      if (piece) controller.enqueue(Uint8Array.from(piece, (digit) => digit.charCodeAt(0)));
      if (at >= text.length) controller.close();
    },
  });
}

async function inflate(text: string, size: number): Promise<ArrayBuffer> {
  const stream = bytesOf(text).pipeThrough(new DecompressionStream('deflate'));
  const all = await new Response(stream).arrayBuffer();
  if (all.byteLength !== size) throw new Error('not the announced size');
  return all;
}

/** The meshes of the scene in order; rejects with a BlockError if the text does not hold what the scene announces. */
export async function readMeshes(text: string, scene: SceneBlock): Promise<RawMesh[]> {
  const size = scene.meshes.reduce((sum, mesh) => sum + 12 * (mesh.vertices + mesh.triangles), 0);
  let bytes: ArrayBuffer;
  try {
    bytes = await inflate(text.replace(/\s+/g, ''), size);
  } catch {
    throw new BlockError('The 3D geometry cannot be read: its block is damaged, or was cut short.');
  }
  let at = 0;
  return scene.meshes.map((mesh, i) => {
    const positions = new Float32Array(bytes, at, 3 * mesh.vertices);
    at += positions.byteLength;
    const corners = new Uint32Array(bytes, at, 3 * mesh.triangles);
    at += corners.byteLength;
    for (const corner of corners) {
      if (corner >= mesh.vertices) throw new BlockError(`The 3D geometry cannot be read: mesh ${i} names no vertex.`);
    }
    return { positions, corners };
  });
}
