// Numbers, texts, elements.

const PREFIXES = {"-12": "p", "-9": "n", "-6": "µ", "-3": "m", "0": "", "3": "k", "6": "M", "9": "G"};

/** What to multiply with, and the prefix: 5.1e-5 is 51 with µ. */
function prefix(largest) {
  if (!(largest > 0)) return [1, ""];
  const power = Math.min(9, Math.max(-12, 3 * Math.floor(Math.log10(largest * 1.0000001) / 3)));
  return [10 ** -power, PREFIXES[power]];
}

/** A number with so many digits, with a true minus sign and without round-off. */
function number(value, digits = 4) {
  if (!Number.isFinite(value)) return "–";
  const rounded = Number(value.toPrecision(digits));
  const size = Math.abs(rounded);
  if (size && (size < 1e-3 || size >= 1e7)) {
    const [mantissa, power] = rounded.toExponential(Math.min(digits, 3) - 1).split("e");
    const raised = [...String(Number(power))].map(digit => digit === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]).join("");
    return `${mantissa.replace("-", "−")}·10${raised}`;
  }
  return String(rounded).replace("-", "−");
}

/** An element with attributes and children; one of SVG where the name begins so. */
function element(name, attributes = {}, ...children) {
  const made = name.startsWith("svg:") ? document.createElementNS("http://www.w3.org/2000/svg", name.slice(4))
    : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined && value !== false) made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children);
  return made;
}

/** A text with its indices set lower: u_z. */
function rich(text) {
  return text.split(/_([a-z]+)/).map((part, k) => k % 2 ? element("sub", {}, part) : part);
}

/** Numbers that Python has written: float64, the lowest byte first, in base 64. */
function decoded(text) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  return new Float64Array(bytes.buffer);
}

/** Tells readers of the screen something, once. */
function tell(text) {
  document.getElementById("told").textContent = text;
}
