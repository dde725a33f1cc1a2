// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The 3D view: draws when something changed, and only then.
import { Color, Scene, SRGBColorSpace, Vector3, WebGLRenderer, WebGLRenderTarget } from 'three';
import type { Assembly, Plane } from './assembly';
import { Camera } from './camera';
import { themeColour } from './colours';
import type { Vec3 } from './data';
import { Overlay, type Stroke } from './overlay';
import { type Box, isEmpty, length, middleOf, radiusOf, sub } from './vector';

/** Single precision has 24 bits; nearer than this to something as far away as one, a rounding would be seen. */
const kNearest = 1 / 4000;

export class View {
  readonly camera: Camera;
  readonly overlay = new Overlay();
  assembly: Assembly | null = null;
  frames = 0;
  /** Called after each frame. */
  onFrame: () => void = () => undefined;

  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly overlayScene = new Scene();
  private readonly pickTarget = new WebGLRenderTarget(1, 1);
  private readonly clearColour = new Color();
  private isAsked = false;

  /** Throws where there is no WebGL 2. */
  constructor(
    private readonly host: HTMLElement,
    readonly canvas: HTMLCanvasElement,
    isStill: () => boolean,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
    this.renderer.autoClear = false;
    this.renderer.sortObjects = true;
    this.camera = new Camera(isStill, () => this.invalidate());
    this.scene.matrixWorldAutoUpdate = false;
    this.overlayScene.add(this.overlay.group);
    new ResizeObserver(() => this.resize()).observe(host);
    canvas.addEventListener('webglcontextrestored', () => this.invalidate());
    this.resize();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    const ratio = Math.min(2, devicePixelRatio || 1);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.overlay.uniforms.size.value.set(width / 2, height / 2);
    this.camera.aspect = width / height;
    this.draw();
  }

  show(assembly: Assembly): void {
    this.assembly = assembly;
    this.scene.add(assembly.parts);
    if (assembly.edges) this.scene.add(assembly.edges);
    this.takeTheme();
  }

  takeTheme(): void {
    const backdrop = themeColour('--backdrop');
    // The renderer takes colours as linear: this one comes out as it is written.
    this.clearColour.setRGB(...backdrop, SRGBColorSpace);
    this.assembly?.uniforms.backdrop.value.set(...backdrop);
    this.overlay.uniforms.halo.value.set(...themeColour('--halo'));
    this.invalidate();
  }

  setSection(plane: Plane | null): void {
    this.assembly?.setSection(plane);
    this.invalidate();
  }

  setStrokes(strokes: Stroke[]): void {
    if (this.assembly) this.overlay.show(strokes, this.assembly.origin);
    this.invalidate();
  }

  /** Flies to where the box fills the view. */
  fit(box: Box): void {
    if (!isEmpty(box)) this.camera.fly({ target: middleOf(box), distance: this.camera.distanceForBox(box) || 1 });
  }

  invalidate(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame((now) => {
      this.isAsked = false;
      this.camera.step(now);
      this.draw();
      if (this.camera.isFlying) this.invalidate();
    });
  }

  private prepare(assembly: Assembly): void {
    const { target, distance } = this.camera.stand;
    if (length(sub(target, assembly.origin)) * kNearest > distance) {
      assembly.setOrigin(target);
      this.overlay.rebuild(target);
    }
    // What explodes leaves the bounds.
    const middle = middleOf(assembly.bounds);
    const { factor, centre } = assembly.explosion;
    const radius = radiusOf(assembly.bounds) * (1 + factor) + factor * length(sub(centre, middle));
    this.camera.update(assembly.origin, middle, radius);
    assembly.uniforms.isParallel.value = this.camera.isParallel ? 1 : 0;
  }

  private draw(): void {
    this.renderer.setClearColor(this.clearColour, 1);
    this.renderer.clear();
    const { assembly } = this;
    if (assembly) {
      this.prepare(assembly);
      const { eye } = this.camera;
      assembly.pass = 'solid';
      this.renderer.render(this.scene, eye);
      if (assembly.hasGhosts) {
        assembly.pass = 'ghost';
        this.renderer.render(assembly.parts, eye);
      }
      this.renderer.render(this.overlayScene, eye);
    }
    ++this.frames;
    this.onFrame();
  }

  /** Where a place of the world is on the page, in CSS pixels. */
  screenPlace(place: Vec3): { x: number; y: number } {
    const { assembly, canvas } = this;
    this.prepare(assembly!);
    const seen = new Vector3(...sub(place, assembly!.origin))
      .applyMatrix4(this.camera.eye.matrixWorldInverse)
      .applyMatrix4(this.camera.eye.projectionMatrix);
    const { left, top, width, height } = canvas.getBoundingClientRect();
    return { x: left + ((seen.x + 1) / 2) * width, y: top + ((1 - seen.y) / 2) * height };
  }

  /** The part seen at a place of the canvas (CSS pixels), -1 for none. */
  pick(x: number, y: number): number {
    const { assembly } = this;
    if (!assembly) return -1;
    this.prepare(assembly);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    // The projection onto that one pixel.
    const { eye } = this.camera;
    const [dx, dy] = [(2 * (x + 0.5)) / width - 1, 1 - (2 * (y + 0.5)) / height];
    const to = eye.projectionMatrix.clone();
    const e = to.elements;
    for (let column = 0; column < 4; ++column) {
      const w = e[4 * column + 3];
      e[4 * column] = (e[4 * column] - dx * w) * width;
      e[4 * column + 1] = (e[4 * column + 1] - dy * w) * height;
    }
    eye.projectionMatrix.copy(to);
    this.renderer.setRenderTarget(this.pickTarget);
    this.renderer.setClearColor(0, 0);
    this.renderer.clear();
    assembly.pass = 'pick';
    this.renderer.render(assembly.parts, eye);
    const bytes = new Uint8Array(4);
    this.renderer.readRenderTargetPixels(this.pickTarget, 0, 0, 1, 1, bytes);
    this.renderer.setRenderTarget(null);
    return assembly.partOfInstance((bytes[0] | (bytes[1] << 8) | (bytes[2] << 16)) - 1);
  }
}
