// A robot, at its board where it has one, as three.js draws it: parts that move, the stroke, a camera to be turned.
class RobotScene {
  // THREE and OrbitControls: what three's modules export.
  constructor(canvas, THREE, OrbitControls) {
    Object.assign(this, { canvas, THREE });
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(28, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableZoom = false;  // until the picture is chosen: the wheel and a swipe move the page
    this.controls.touches = { ONE: THREE.TOUCH.ROTATE, TWO: THREE.TOUCH.DOLLY_ROTATE };
    canvas.style.touchAction = "pan-y";
    canvas.addEventListener("focus", () => { this.controls.enableZoom = true; });
    canvas.addEventListener("blur", () => { this.controls.enableZoom = false; });
    canvas.addEventListener("pointerdown", () => canvas.focus({ preventScroll: true }));
    this.controls.addEventListener("change", () => this.draw());
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x9a958c, 1.6));
    this.sun = new THREE.DirectionalLight(0xffffff, 2.2);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.bias = -0.0005;
    this.sun.shadow.normalBias = 0.002;
    this.scene.add(this.sun, this.sun.target);
    this.set = new THREE.Group();
    this.scene.add(this.set);
  }

  material(colour, more = {}) {
    return new this.THREE.MeshStandardMaterial({ color: colour, roughness: 0.62, metalness: 0.02, ...more });
  }
  mesh(positions, corners, material, normals) {
    const { THREE } = this, geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    if (normals) geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
    geometry.setIndex(new THREE.BufferAttribute(corners, 1));
    return new THREE.Mesh(geometry, material);
  }

  // Puts another robot at its board. Its colours are sRGB.
  show(body) {
    const { THREE } = this;
    this.set.traverse((object) => { object.geometry?.dispose(); object.material?.dispose(); });
    this.set.clear();
    this.body = body;
    this.pen = null;
    this.parts = body.parts.map(() => {
      const group = new THREE.Group();
      group.matrixAutoUpdate = false;
      this.set.add(group);
      return group;
    });
    for (const { part, colour, opacity, positions, normals, corners } of body.surfaces()) {
      const seen = opacity < 1 ? { transparent: true, opacity } : {};
      const mesh = this.mesh(positions, corners, this.material(new THREE.Color().setRGB(...colour, THREE.SRGBColorSpace), seen), normals);
      mesh.castShadow = mesh.receiveShadow = opacity === 1;
      this.parts[part].add(mesh);
    }
    if (body.plane) {
      this.addBoard();
      this.addPen();
    }
    this.pose(body.lower.map((low, k) => Math.min(Math.max(0, low), body.upper[k])));
    this.addGround();
    this.resetView();
  }

  addBoard() {
    const { THREE, body } = this, size = body.half_side * body.plane.scale;
    const { u, v } = body.plane, normal = cross3(u, v);
    this.board = new THREE.Group();
    this.board.matrixAutoUpdate = false;
    this.board.matrix.set(u[0], v[0], normal[0], body.plane.origin[0], u[1], v[1], normal[1], body.plane.origin[1],
                          u[2], v[2], normal[2], body.plane.origin[2], 0, 0, 0, 1);
    this.thickness = 0.02 * size;
    const pane = new THREE.Mesh(new THREE.BoxGeometry(2 * size, 2 * size, this.thickness),
      this.material(0xdfeef5, { transparent: true, opacity: 0.34, roughness: 0.2, depthWrite: false }));
    pane.position.z = -this.thickness;
    this.board.add(pane);
    const frame = this.material(0x8a929c);
    for (const side of [-1, 1])
      for (const [width, height, x, y] of [[2 * size + 2 * this.thickness, this.thickness, 0, side * size], [this.thickness, 2 * size, side * size, 0]]) {
        const rail = new THREE.Mesh(new THREE.BoxGeometry(width, height, 1.6 * this.thickness), frame);
        rail.position.set(x, y, -this.thickness);
        rail.castShadow = true;
        this.board.add(rail);
      }
    this.set.add(this.board);
    this.strokes = [];
  }

  // Its point is the pen's; it leans from the board's normal.
  addPen() {
    const { THREE, body } = this, length = 0.085 * Math.sqrt(body.plane.scale / 0.258), radius = 0.05 * length;
    this.pen = new THREE.Group();
    const tip = new THREE.Mesh(new THREE.ConeGeometry(radius, 0.16 * length, 20), this.material(0xcc5500));
    const shaft = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, 0.84 * length, 20), this.material(0x2a2d31));
    tip.rotation.x = Math.PI;
    tip.position.y = 0.08 * length;
    shaft.position.y = 0.58 * length;
    shaft.castShadow = true;
    this.pen.add(tip, shaft);
    const { u, v } = body.plane, lean = new THREE.Vector3(...cross3(u, v)).multiplyScalar(0.88)
      .addScaledVector(new THREE.Vector3(0, 0, 1), 0.35).normalize();
    this.pen.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), lean);
    this.set.add(this.pen);
  }

  addGround() {
    const { THREE } = this;
    this.scene.updateMatrixWorld(true);
    this.bounds = new THREE.Box3().setFromObject(this.set);
    const middle = this.bounds.getCenter(new THREE.Vector3()), size = this.bounds.getSize(new THREE.Vector3()).length();
    const ground = new THREE.Mesh(new THREE.CircleGeometry(1.1 * size, 64), new THREE.ShadowMaterial({ opacity: 0.22 }));
    ground.position.set(middle.x, middle.y, this.bounds.min.z - 0.001 * size);
    ground.receiveShadow = true;
    this.set.add(ground);
    this.sun.position.copy(middle).add(new THREE.Vector3(-0.35, -0.5, 1.1).multiplyScalar(size));
    this.sun.target.position.copy(middle);
    const { camera } = this.sun.shadow;
    Object.assign(camera, { left: -size, right: size, top: size, bottom: -size, near: 0.05 * size, far: 3 * size });
    camera.updateProjectionMatrix();
  }

  // From the side of the arm that draws, over its shoulder: the drawing as the robot sees it. Without a board from
  // before its left.
  resetView() {
    const { THREE, body } = this, { u, v, origin } = body.plane ?? { u: [0, 1, 0], v: [0, 0, 1], origin: [0, 0, 0] }, normal = cross3(u, v);
    const middle = this.bounds.getCenter(new THREE.Vector3()), size = this.bounds.getSize(new THREE.Vector3()).length();
    const turn = (dot3(u, origin) >= 0 ? 1 : -1) * 0.62, azimuth = Math.atan2(normal[1], normal[0]) + turn;
    const distance = (body.plane ? 0.43 : 0.58) * size / Math.sin(this.camera.fov * Math.PI / 360) / Math.min(1, this.camera.aspect);
    this.controls.target.copy(middle);
    this.camera.position.set(Math.cos(0.3) * Math.cos(azimuth), Math.cos(0.3) * Math.sin(azimuth), Math.sin(0.3))
      .multiplyScalar(distance).add(middle);
    this.camera.near = distance / 100;
    this.camera.far = distance * 10;
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = 0.2 * distance;
    this.controls.maxDistance = 3 * distance;
    this.controls.update();
  }

  // Turns the camera about what it looks at (rad), and brings it nearer (shares of the distance).
  orbit(across, up, nearer) {
    const { THREE } = this, away = this.camera.position.clone().sub(this.controls.target);
    const turned = new THREE.Spherical().setFromVector3(new THREE.Vector3(away.x, away.z, -away.y));
    turned.theta += across;
    turned.phi = Math.min(Math.max(turned.phi - up, 0.05), Math.PI - 0.05);
    turned.radius = Math.min(Math.max(turned.radius * (1 - nearer), this.controls.minDistance), this.controls.maxDistance);
    away.setFromSpherical(turned);
    this.camera.position.set(away.x, -away.z, away.y).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  // The frames that it takes.
  pose(joints) {
    const frames = this.body.frames(joints);
    frames.forEach((f, part) => { this.parts[part].matrix.set(...f, 0, 0, 0, 1); });
    this.pen?.position.set(...this.body.penOf(frames));
    return frames;
  }

  // Strokes on the board: the arm's, thin, and the robot's own, of which reveal() shows a share.
  setStrokes(reference, own) {
    for (const stroke of this.strokes) { stroke.removeFromParent(); stroke.geometry.dispose(); stroke.material.dispose(); }
    const { scale } = this.body.plane, width = 0.0095 * scale;
    const add = (pen, half, colour, height) => {
      const { positions, corners } = ribbon(pen, half, scale, height);
      const stroke = this.mesh(positions, corners, new this.THREE.MeshBasicMaterial({ color: colour, side: this.THREE.DoubleSide }));
      this.board.add(stroke);
      return stroke;
    };
    this.strokes = [add(reference, 0.3 * width, 0x7d8791, 0.1 * width), add(own, width, 0xcc4a12, 0.2 * width)];
  }
  // The first `points` of the robot's own stroke.
  reveal(points) { this.strokes[1]?.geometry.setDrawRange(0, Math.max(0, points) * kRibbonCorners); }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
  draw() { if (this.body) this.renderer.render(this.scene, this.camera); }
}

// A polyline of the pen (metres of the arm) as a flat ribbon: of every point a disc of eight triangles, and the two
// triangles that lead there from the point before.
const kRibbonCorners = 30;
function ribbon(pen, half, scale, height) {
  const positions = new Float32Array(pen.length * 13 * 3), corners = new Uint32Array(pen.length * kRibbonCorners);
  pen.forEach(([px, py], k) => {
    const x = px * scale, y = py * scale, [bx, by] = pen[Math.max(0, k - 1)].map((value) => value * scale), first = 13 * k;
    const length = Math.hypot(x - bx, y - by) || 1, nx = -(y - by) / length * half, ny = (x - bx) / length * half;
    const vertices = [[x, y]];
    for (let side = 0; side < 8; ++side)
      vertices.push([x + half * Math.cos(side * Math.PI / 4), y + half * Math.sin(side * Math.PI / 4)]);
    vertices.push([bx + nx, by + ny], [bx - nx, by - ny], [x - nx, y - ny], [x + nx, y + ny]);
    vertices.forEach(([vx, vy], i) => positions.set([vx, vy, height], 3 * (first + i)));
    const triangles = [];
    for (let side = 0; side < 8; ++side) triangles.push(first, first + 1 + side, first + 1 + (side + 1) % 8);
    triangles.push(first + 9, first + 10, first + 11, first + 9, first + 11, first + 12);
    corners.set(triangles, k * kRibbonCorners);
  });
  return { positions, corners };
}
