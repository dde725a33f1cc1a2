// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// What is drawn over the parts: lines of a few pixels with a halo, so that they are seen on every ground.
import {
  Float32BufferAttribute,
  Group,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  ShaderMaterial,
  Vector2,
  Vector3,
} from 'three';
import type { Rgb } from './colours';
import type { Vec3 } from './data';
import { lineFragment, lineVertex } from './shaders';
import { sub } from './vector';

export interface Stroke {
  points: Vec3[];
  colour: Rgb;
  /** Half the width in CSS pixels. A stroke of one point, or of two equal ones, is a dot. */
  width: number;
}

interface Uniforms {
  size: { value: Vector2 };
  halo: { value: Vector3 };
}

function lineMesh(strokes: Stroke[], origin: Vec3, shared: Uniforms, width: number, isHalo: boolean): Mesh {
  const [from, to, tint]: number[][] = [[], [], []];
  for (const { points, colour } of strokes) {
    const placed = points.map((p) => sub(p, origin));
    for (let i = 0; i < Math.max(1, placed.length - 1); ++i) {
      from.push(...placed[i]);
      to.push(...(placed[i + 1] ?? placed[i]));
      tint.push(...colour);
    }
  }
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  geometry.setAttribute('from', new InstancedBufferAttribute(Float32Array.from(from), 3));
  geometry.setAttribute('to', new InstancedBufferAttribute(Float32Array.from(to), 3));
  geometry.setAttribute('tint', new InstancedBufferAttribute(Float32Array.from(tint), 3));
  geometry.instanceCount = from.length / 3;
  const material = new ShaderMaterial({
    uniforms: {
      ...shared,
      width: { value: width },
      isHalo: { value: isHalo ? 1 : 0 },
      strength: { value: isHalo ? 0.75 : 1 },
    },
    vertexShader: lineVertex,
    fragmentShader: lineFragment,
    depthTest: false,
    depthWrite: false,
    transparent: true,
  });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

export class Overlay {
  readonly group = new Group();
  readonly uniforms: Uniforms = { size: { value: new Vector2(1, 1) }, halo: { value: new Vector3(1, 1, 1) } };
  private strokes: Stroke[] = [];

  show(strokes: Stroke[], origin: Vec3): void {
    this.strokes = strokes.filter((stroke) => stroke.points.length > 0);
    this.rebuild(origin);
  }

  rebuild(origin: Vec3): void {
    for (const child of this.group.children as Mesh[]) {
      child.geometry.dispose();
      (child.material as ShaderMaterial).dispose();
    }
    this.group.clear();
    const widths = [...new Set(this.strokes.map((stroke) => stroke.width))].sort((x, y) => x - y);
    for (const width of widths) {
      const strokes = this.strokes.filter((stroke) => stroke.width === width);
      [true, false].forEach((isHalo) => {
        const mesh = lineMesh(strokes, origin, this.uniforms, isHalo ? width + 1.5 : width, isHalo);
        mesh.renderOrder = isHalo ? 0 : 1 + width;
        this.group.add(mesh);
      });
    }
  }
}
