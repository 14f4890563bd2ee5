// The map and the controls of drive(robot). A command is sent as long as a key, a button or a stick is held,
// and a stop when it is released. Nothing else drives the robot, which stops by itself without commands.

const PERIOD = 100;  // milliseconds between commands
const SILENCE = 2000;  // milliseconds without the robot's odometry until the pad says so
const FREE = 0.05;  // metres from the place of a bump
const DEAD_ZONE = 0.15;  // of a stick
const SLOW = 0.5;  // with Shift
const SPEED = {linear: 0.3, angular: 1.2};  // m/s and rad/s of a held key
const KEYS = {
    ArrowUp: "forward", KeyW: "forward", ArrowDown: "back", KeyS: "back",
    ArrowLeft: "left", KeyA: "left", ArrowRight: "right", KeyD: "right",
};
const BUTTONS = [["forward", "▲"], ["left", "◀"], ["stop", "■"], ["right", "▶"], ["back", "▼"]];
const GAMEPAD_BUTTONS = {12: "forward", 13: "back", 14: "left", 15: "right"};
const HELP = "Click here or press Tab, then hold an arrow key, or W A S D. Shift: slowly. A gamepad works too.";
const SVG = "http://www.w3.org/2000/svg";

function add(parent, tag, attributes, text = "") {
    const isSvg = parent.namespaceURI === SVG || tag === "svg";
    const node = isSvg ? document.createElementNS(SVG, tag) : document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
    node.textContent = text;
    parent.append(node);
    return node;
}

// What is held: "key KeyW" or "button left", each with its direction.
function makeCommand(held, isSlow) {
    const has = direction => [...held.values()].includes(direction) ? 1 : 0;
    let linear = has("forward") - has("back");
    let angular = has("left") - has("right");
    for (const gamepad of navigator.getGamepads().filter(Boolean)) {
        const pressed = direction => Object.entries(GAMEPAD_BUTTONS)
            .some(([k, name]) => name === direction && gamepad.buttons[k]?.pressed) ? 1 : 0;
        const stick = k => Math.abs(gamepad.axes[k] ?? 0) > DEAD_ZONE ? gamepad.axes[k] : 0;
        linear += pressed("forward") - pressed("back") - stick(1);
        angular += pressed("left") - pressed("right") - stick(0);
    }
    const scale = isSlow ? SLOW : 1;
    const limited = value => Math.max(-1, Math.min(1, value)) * scale;
    return {linear: limited(linear) * SPEED.linear, angular: limited(angular) * SPEED.angular};
}

function makeMap(root) {
    const svg = add(root, "svg", {class: "imgproc-map", role: "img"});
    const title = add(svg, "title", {}, "Map from above, ahead at the start is up; no odometry yet");
    // x of the map (ahead) is up, y is to the left.
    const map = add(svg, "g", {transform: "rotate(-90) scale(1 -1)"});
    const grid = add(map, "path", {class: "imgproc-grid"});
    const walls = add(map, "path", {class: "imgproc-walls"});
    const movers = add(map, "path", {class: "imgproc-movers"});
    const trace = add(map, "polyline", {class: "imgproc-trace"});
    const robot = add(map, "path", {class: "imgproc-robot", d: "M -.15 .12 H .14 L .237 0 L .14 -.12 H -.15 Z"});
    const cells = new Map();  // "x,y" of a corner: the square as a path
    let box;

    function clear() {
        box = [-1, -1, 1, 1];
        cells.clear();
        trace.setAttribute("points", "");
    }

    function grow(x, y) {
        const [left, low, right, high] = box;
        box = [Math.min(left, x), Math.min(low, y), Math.max(right, x), Math.max(high, y)];
    }

    function fit() {
        const [left, low, right, high] = box.map((value, k) => value + (k < 2 ? -0.3 : 0.3));
        // rotate(-90) scale(1 -1) takes (x, y) of the map to (-y, -x) of the screen.
        svg.setAttribute("viewBox", `${-high} ${-right} ${high - low} ${right - left}`);
        let lines = "";
        for (let x = Math.ceil(left); x <= right; x += 1) lines += `M${x} ${low}V${high}`;
        for (let y = Math.ceil(low); y <= high; y += 1) lines += `M${left} ${y}H${right}`;
        grid.setAttribute("d", lines);
    }

    clear();
    return message => {
        if (message.begins) clear();
        for (const [x, y] of [...message.trace, ...message.cells]) grow(x, y);
        const square = ([x, y]) => `M${x} ${y}h.05v.05h-.05z`;
        for (const corner of message.cells) cells.set(corner.join(), square(corner));
        movers.setAttribute("d", message.moving.map(square).join(""));
        for (const corner of message.gone) cells.delete(corner.join());
        walls.setAttribute("d", [...cells.values()].join(""));
        const points = message.trace.map(point => point.join()).join(" ");
        if (points) trace.setAttribute("points", `${trace.getAttribute("points")} ${points}`);
        const [x, y, yaw] = message.pose;
        robot.setAttribute("transform", `translate(${x} ${y}) rotate(${yaw * 180 / Math.PI})`);
        fit();
        title.textContent = `Map from above, ahead at the start is up; the robot is at x ${x.toFixed(1)} m, `
            + `y ${y.toFixed(1)} m`;
    };
}

function render({model, el}) {
    const root = add(el, "div", {
        class: "imgproc-drive", tabindex: "0", role: "application", "aria-label": `Drive the robot. ${HELP}`,
        // JupyterLab leaves all keys in here alone: beside S is X, which cuts the cell in its command mode.
        "data-lm-suppress-shortcuts": "true",
    });
    const showMap = makeMap(root);
    const legend = add(root, "div", {class: "imgproc-legend"});
    for (const name of ["robot", "path", "walls", "what moves"]) add(legend, "span", {}, name);
    add(legend, "div", {}, "Seen by the laser scanner. One square of the grid is 1 m wide.");
    const controls = add(root, "div", {class: "imgproc-controls"});
    const buttons = add(controls, "div", {class: "imgproc-buttons"});
    for (const [name, sign] of BUTTONS) {
        const label = name === "stop" ? "stop" : `drive ${name}`.replace(/drive (left|right)/, "turn $1");
        add(buttons, "button", {type: "button", "aria-label": label, title: label, "data-name": name}, sign);
    }
    const texts = add(controls, "div", {class: "imgproc-texts"});
    const state = add(texts, "div", {class: "imgproc-state", role: "status"});
    const numbers = add(texts, "div", {class: "imgproc-numbers"});
    add(texts, "div", {class: "imgproc-help"}, HELP);
    const restart = add(controls, "button", {type: "button", class: "imgproc-restart"}, "Restart");
    restart.title = "Everything in the room begins again";

    const held = new Map();
    let isSlow = false, isMoving = false, lastMap = performance.now();
    let bumps = null, bumpPlace = null;  // how many so far, and where the last one was

    const send = command => model.send({...command, time: Date.now() / 1000});
    const hasFocus = () => document.hasFocus() && root.contains(document.activeElement);

    function say(text) {
        if (state.textContent !== text) state.textContent = text;
    }

    function tick() {
        if (!hasFocus()) held.clear();
        const command = hasFocus() ? makeCommand(held, isSlow) : {linear: 0, angular: 0};
        const moves = command.linear !== 0 || command.angular !== 0;
        if (moves) send({kind: "drive", ...command});
        else if (isMoving) send({kind: "stop", linear: 0, angular: 0});
        isMoving = moves;
        if (performance.now() - lastMap > SILENCE) say("no odometry comes");
        else if (bumpPlace) say("bumped: drive back");
        else if (!hasFocus()) say("not driving: no focus");
        else say(moves ? "driving" : "ready");
    }

    function release() {
        held.clear();
        tick();
    }

    function hold(source, direction) {
        if (held.get(source) === direction) return;
        held.set(source, direction);
        tick();
    }

    function press(source, name) {
        name === "stop" ? release() : hold(source, name);
    }

    function letGo(source) {
        if (held.delete(source)) tick();
    }

    root.addEventListener("keydown", event => {
        if (event.ctrlKey || event.metaKey || event.altKey) return release();
        isSlow = event.shiftKey;
        const name = event.target.dataset.name;
        if (KEYS[event.code]) hold(`key ${event.code}`, KEYS[event.code]);
        else if (name && (event.code === "Space" || event.code === "Enter")) press(`press ${name}`, name);
        else return;
        event.preventDefault();
    });
    root.addEventListener("keyup", event => {
        isSlow = event.shiftKey;
        letGo(`key ${event.code}`);
        if (event.code === "Space" || event.code === "Enter") letGo(`press ${event.target.dataset.name}`);
    });
    for (const button of buttons.children) {
        const source = `button ${button.dataset.name}`;
        button.addEventListener("pointerdown", event => {
            button.focus();  // Safari does not by itself
            event.preventDefault();
            press(source, button.dataset.name);
        });
        for (const end of ["pointerup", "pointerleave", "pointercancel"]) {
            button.addEventListener(end, () => letGo(source));
        }
    }
    restart.addEventListener("click", () => send({kind: "restart"}));
    root.addEventListener("focusin", tick);
    root.addEventListener("focusout", () => setTimeout(tick));  // the focus may go to one of the buttons
    const ends = new AbortController();
    for (const name of ["blur", "pagehide"]) window.addEventListener(name, release, {signal: ends.signal});
    document.addEventListener("visibilitychange", release, {signal: ends.signal});

    const onMap = message => {
        lastMap = performance.now();
        showMap(message);
        const [x, y, yaw] = message.pose, [linear, angular] = message.speed;
        if (bumps !== null && message.bumps > bumps) bumpPlace = [x, y];
        else if (bumpPlace && Math.hypot(x - bumpPlace[0], y - bumpPlace[1]) > FREE) bumpPlace = null;
        bumps = message.bumps;
        numbers.textContent = `x ${x.toFixed(2)} m, y ${y.toFixed(2)} m, ${Math.round(yaw * 180 / Math.PI)}°\n`
            + `${linear.toFixed(2)} m/s, ${angular.toFixed(2)} rad/s`;
    };
    model.on("msg:custom", onMap);
    const timer = setInterval(tick, PERIOD);
    send({kind: "hello"});
    return () => {
        clearInterval(timer);
        ends.abort();
        model.off("msg:custom", onMap);
        send({kind: "stop", linear: 0, angular: 0});
    };
}

export default {render};
