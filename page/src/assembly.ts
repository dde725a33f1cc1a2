// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The parts in 3D: one batch with a draw for each part, and one of lines for all edges. Poses and looks lie in textures.
//
// World coordinates may be huge. All that is kept of them is in doubles; what goes to the device is taken relative to `origin`,
// which follows the camera when it comes so near to something far from it that single precision would show.
import {
  BatchedMesh,
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  DoubleSide,
  FloatType,
  LineSegments,
  NearestFilter,
  RGBAFormat,
  ShaderMaterial,
  UnsignedByteType,
  Vector3,
  Vector4,
} from 'three';
import type { Rgb } from './colours';
import type { SceneBlock, Vec3 } from './data';
import { Breather, type RawMesh } from './geometry';
import { drawnMesh, type DrawnMesh } from './mesh';
import { matrixOf, type Pose } from './pose';
import type { Obstacle } from './sight';
import { edgeFragment, edgeVertex, partFragment, partVertex, pickFragment } from './shaders';
import { add, type Box, dot, emptyBox, grow, isEmpty, middleOf, scale, sub, unite } from './vector';

/** How a part looks: alpha 1 is solid, between 0 and 1 it fades, 0 hides it. */
export type Look = [...Rgb, number];

/** In world coordinates; what lies beyond it is cut away. Without a direction it cuts nothing. */
export interface Plane {
  normal: Vec3;
  offset: number;
}

const kMostEdgeEnds = 6_000_000;

/** About square, with rows of whole groups of `group` texels. */
function texture<T extends Float32Array | Uint8Array>(type: new (size: number) => T, texels: number, group: number) {
  const width = Math.max(group, Math.ceil(Math.sqrt(texels) / group) * group);
  const height = Math.ceil(texels / width);
  const data = new type(4 * width * height);
  const made = new DataTexture(data, width, height, RGBAFormat, data instanceof Float32Array ? FloatType : UnsignedByteType);
  made.minFilter = made.magFilter = NearestFilter;
  made.needsUpdate = true;
  return { data, texture: made };
}

export class Assembly {
  readonly parts: BatchedMesh;
  readonly edges: LineSegments | null;
  /** Of each part, in world coordinates and without explosion. */
  readonly boxes: Box[];
  /** Of all of them, and of all that their motion sweeps. */
  readonly bounds: Box;
  readonly uniforms;
  origin: Vec3;
  hasGhosts = false;

  private readonly poses: Pose[];
  private readonly instanceOf: Int32Array;
  private readonly partOf: number[] = [];
  private readonly placed: { data: Float32Array; texture: DataTexture };
  private readonly looks: { data: Uint8Array; texture: DataTexture };
  private readonly materials: { solid: ShaderMaterial; ghost: ShaderMaterial; pick: ShaderMaterial };
  private section: Plane = { normal: [0, 0, 0], offset: 0 };
  explosion = { factor: 0, centre: [0, 0, 0] as Vec3 };

  private constructor(
    private readonly scene: SceneBlock,
    private readonly meshes: (DrawnMesh | null)[],
  ) {
    this.instanceOf = new Int32Array(scene.objects.length).fill(-1);
    scene.objects.forEach((object, id) => {
      if (object.mesh < 0 || !meshes[object.mesh]) return;
      this.instanceOf[id] = this.partOf.length;
      this.partOf.push(id);
    });
    this.poses = scene.objects.map((object) => object.pose);
    this.boxes = scene.objects.map((_, id) => this.boxAt(id, this.poses[id]));
    this.bounds = unite(this.boxes);
    this.origin = middleOf(this.bounds);

    const count = Math.max(1, this.partOf.length);
    this.placed = texture(Float32Array, 3 * count, 3);
    this.looks = texture(Uint8Array, count, 1);
    this.looks.data.fill(255);
    this.uniforms = {
      poses: { value: this.placed.texture },
      looks: { value: this.looks.texture },
      section: { value: new Vector4() },
      backdrop: { value: new Vector3() },
      ink: { value: new Vector3(0.07, 0.08, 0.1) },
      strength: { value: 0.45 },
      isParallel: { value: 0 },
      recessed: { value: -1 },
    };
    this.materials = this.makeMaterials();
    this.parts = this.makeBatch(meshes);
    this.edges = this.makeEdges(meshes);
    this.place();
  }

  /** Makes all that is drawn, in steps between which the page stays responsive. */
  static async create(scene: SceneBlock, raw: RawMesh[]): Promise<Assembly> {
    const uses = new Array<number>(raw.length).fill(0);
    for (const object of scene.objects) if (object.mesh >= 0) ++uses[object.mesh];
    const drawn = raw.reduce((sum, mesh, i) => sum + uses[i] * mesh.corners.length, 0) / 3;
    const withEdges = drawn < 4_000_000;
    const breather = new Breather();
    const meshes: (DrawnMesh | null)[] = [];
    for (const [i, mesh] of raw.entries()) {
      meshes.push(uses[i] && mesh.corners.length ? drawnMesh(mesh, withEdges) : null);
      await breather.breathe();
    }
    return new Assembly(scene, meshes);
  }

  private makeMaterials() {
    const common = {
      uniforms: this.uniforms,
      vertexShader: partVertex,
      side: DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    };
    return {
      solid: new ShaderMaterial({ ...common, fragmentShader: partFragment }),
      ghost: new ShaderMaterial({
        ...common,
        fragmentShader: partFragment,
        defines: { GHOST: '' },
        transparent: true,
        forceSinglePass: true,
        depthWrite: false,
      }),
      pick: new ShaderMaterial({ ...common, fragmentShader: pickFragment }),
    };
  }

  private makeBatch(meshes: (DrawnMesh | null)[]): BatchedMesh {
    let [vertices, corners] = [1, 3];
    for (const mesh of meshes) {
      vertices += mesh ? mesh.positions.length / 3 : 0;
      corners += mesh?.corners.length ?? 0;
    }
    const batch = new BatchedMesh(Math.max(1, this.partOf.length), vertices, corners, this.materials.solid);
    const geometries = meshes.map((mesh) => {
      if (!mesh) return -1;
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(mesh.positions, 3));
      geometry.setAttribute('normal', new BufferAttribute(mesh.normals, 4, true));
      geometry.setIndex(new BufferAttribute(mesh.corners, 1));
      return batch.addGeometry(geometry);
    });
    for (const id of this.partOf) batch.addInstance(geometries[this.scene.objects[id].mesh]);
    batch.sortObjects = false;
    batch.frustumCulled = false;
    batch.matrixAutoUpdate = false;
    return batch;
  }

  private makeEdges(meshes: (DrawnMesh | null)[]): LineSegments | null {
    const size = this.partOf.reduce((sum, id) => sum + meshes[this.scene.objects[id].mesh]!.edges.length, 0);
    if (size === 0 || size / 3 > kMostEdgeEnds) return null;
    const positions = new Float32Array(size);
    const parts = new Float32Array(size / 3);
    let at = 0;
    this.partOf.forEach((id, instance) => {
      const { edges } = meshes[this.scene.objects[id].mesh]!;
      positions.set(edges, at);
      parts.fill(instance, at / 3, (at + edges.length) / 3);
      at += edges.length;
    });
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setAttribute('part', new BufferAttribute(parts, 1));
    const material = new ShaderMaterial({
      uniforms: this.uniforms,
      vertexShader: edgeVertex,
      fragmentShader: edgeFragment,
      transparent: true,
      depthWrite: false,
    });
    const lines = new LineSegments(geometry, material);
    lines.frustumCulled = false;
    return lines;
  }

  /** Which of the passes the batch is drawn in next. */
  set pass(pass: 'solid' | 'ghost' | 'pick') {
    this.parts.material = this.materials[pass];
  }

  hasMesh(id: number): boolean {
    return this.instanceOf[id] >= 0;
  }

  partOfInstance(instance: number): number {
    return this.partOf[instance] ?? -1;
  }

  /** What of a part can hide something, null if it has no triangles. */
  obstacle(id: number): Obstacle | null {
    const drawn = this.meshes[this.scene.objects[id].mesh];
    return drawn ? { positions: drawn.positions, corners: drawn.corners, pose: this.poses[id] } : null;
  }

  setLooks(lookOf: (id: number) => Look): void {
    this.hasGhosts = false;
    this.partOf.forEach((id, instance) => {
      const look = lookOf(id);
      for (let k = 0; k < 4; ++k) this.looks.data[4 * instance + k] = Math.round(255 * look[k]);
      const alpha = this.looks.data[4 * instance + 3];
      if (alpha > 0 && alpha < 255) this.hasGhosts = true;
      this.parts.setVisibleAt(instance, alpha > 0);
    });
    this.looks.texture.needsUpdate = true;
  }

  /** Where faces of this part lie in others, the others are seen; -1 for none. */
  setRecessed(id: number): void {
    this.uniforms.recessed.value = this.instanceOf[id] ?? -1;
  }

  setSection(plane: Plane | null): void {
    this.section = plane ?? { normal: [0, 0, 0], offset: 0 };
    const { normal, offset } = this.section;
    this.uniforms.section.value.set(...normal, offset - dot(normal, this.origin));
  }

  setExplosion(factor: number, centre: Vec3): void {
    this.explosion = { factor, centre };
    this.place();
  }

  /** All that the parts sweep is within the bounds. */
  setSweep(objects: { id: number; poses: Pose[] }[]): void {
    for (const { id, poses } of objects) {
      for (const pose of poses) {
        const box = this.boxAt(id, pose);
        if (!isEmpty(box)) grow(this.bounds, box.min, box.max);
      }
    }
  }

  movePart(id: number, pose: Pose): void {
    this.poses[id] = pose;
    this.boxes[id] = this.boxAt(id, pose);
  }

  poseOf(id: number): Pose {
    return this.poses[id];
  }

  private boxAt(id: number, pose: Pose): Box {
    return worldBox(pose, this.meshes[this.scene.objects[id].mesh] ?? null);
  }

  setOrigin(origin: Vec3): void {
    this.origin = origin;
    this.setSection(this.section);
    this.place();
  }

  /** How far the explosion moves a part. */
  shiftOf(id: number): Vec3 {
    const { factor, centre } = this.explosion;
    return factor === 0 ? [0, 0, 0] : scale(sub(middleOf(this.boxes[id]), centre), factor);
  }

  /** After parts have moved. */
  place(): void {
    this.partOf.forEach((id, instance) => {
      const pose = this.poses[id];
      const matrix = matrixOf(pose).setPosition(
        ...add(sub([pose[3], pose[7], pose[11]], this.origin), this.shiftOf(id)),
      );
      for (let k = 0; k < 12; ++k) this.placed.data[12 * instance + k] = matrix.elements[(k % 4) * 4 + (k >> 2)];
      this.parts.setMatrixAt(instance, matrix);
    });
    this.placed.texture.needsUpdate = true;
  }
}

function worldBox(pose: number[], mesh: DrawnMesh | null): Box {
  const box = emptyBox();
  const local = mesh ?? box;
  if (isEmpty(local)) return box;
  const middle = middleOf(local);
  const half = scale(sub(local.max, local.min), 0.5);
  for (let k = 0; k < 3; ++k) {
    const [u, v, w, shift] = pose.slice(4 * k, 4 * k + 4);
    const centre = u * middle[0] + v * middle[1] + w * middle[2] + shift;
    const reach = Math.abs(u) * half[0] + Math.abs(v) * half[1] + Math.abs(w) * half[2];
    [box.min[k], box.max[k]] = [centre - reach, centre + reach];
  }
  return box;
}
