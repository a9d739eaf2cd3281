// A slider for each light and each parameter of the shaders.
import { Color, LinearSRGBColorSpace, MathUtils, SRGBColorSpace, Spherical, Vector3 } from 'three';
import type { RedmapParameter } from '../redmap/index.js';
import type { Stage, StageLight, StageObject } from './stage.js';

/** Ranges that span more than this get a logarithmic slider. */
const kWide = 100;
const kSliderSteps = 1000;
/** Lights are made this much brighter or dimmer at most. */
const kBrightest = 8;

function element<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  properties: Partial<HTMLElementTagNameMap[Name]> = {},
  children: (Node | string)[] = [],
): HTMLElementTagNameMap[Name] {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

interface SliderOptions {
  label: string;
  minimum: number;
  maximum: number;
  logarithmic?: boolean;
  whole?: boolean;
  unit?: string;
}

const shown = (value: number) => Number(value.toPrecision(3)).toString();

/** A row with a slider; returns it and what sets it from outside. */
function slider(options: SliderOptions, value: number, onInput: (value: number) => void): HTMLLabelElement {
  const { label, minimum, maximum, logarithmic, whole, unit } = options;
  const toPart = (v: number) =>
    logarithmic ? Math.log(v / minimum) / Math.log(maximum / minimum) : (v - minimum) / (maximum - minimum);
  const fromPart = (t: number) => {
    const v = logarithmic ? minimum * (maximum / minimum) ** t : minimum + t * (maximum - minimum);
    return whole ? Math.round(v) : v;
  };
  const output = element('output', { value: shown(value) });
  const input = element('input', { type: 'range', min: '0', max: String(kSliderSteps), step: '1' });
  input.value = String(kSliderSteps * toPart(value));
  input.addEventListener('input', () => {
    const next = fromPart(Number(input.value) / kSliderSteps);
    output.value = shown(next);
    onInput(next);
  });
  const name = element('span', { className: 'name' }, [label]);
  const number = element('span', { className: 'number' }, [output, unit ? ` ${unit}` : '']);
  return element('label', {}, [name, number, input]);
}

function colorRow(label: string, value: number[], onInput: (value: number[]) => void): HTMLLabelElement {
  const color = new Color().setRGB(value[0]!, value[1]!, value[2]!, LinearSRGBColorSpace);
  const input = element('input', { type: 'color', value: `#${color.getHexString(SRGBColorSpace)}` });
  input.addEventListener('input', () => {
    const chosen = new Color(input.value);
    onInput([chosen.r, chosen.g, chosen.b]);
  });
  return element('label', { className: 'color' }, [element('span', { className: 'name' }, [label]), input]);
}

function lightRows({ description, light }: StageLight, onChange: () => void): HTMLElement[] {
  const rows: HTMLElement[] = [];
  const brightness = { label: 'brightness', minimum: 1 / kBrightest, maximum: kBrightest, logarithmic: true };
  rows.push(
    slider(brightness, 1, value => {
      light.intensity = value;
      onChange();
    }),
  );
  const at = new Spherical().setFromVector3(new Vector3(...description.place));
  const place = () => {
    light.position.setFromSpherical(at);
    onChange();
  };
  const around = { label: 'around', minimum: -180, maximum: 180, unit: '°' };
  const above = { label: 'above', minimum: -89, maximum: 89, unit: '°' };
  rows.push(
    slider(around, MathUtils.radToDeg(at.theta), value => {
      at.theta = MathUtils.degToRad(value);
      place();
    }),
    slider(above, 90 - MathUtils.radToDeg(at.phi), value => {
      at.phi = MathUtils.degToRad(90 - value);
      place();
    }),
  );
  return rows;
}

const isColor = ({ type, minimum, maximum }: RedmapParameter) => type === 'vec3' && minimum === 0 && maximum === 1;

function parameterRows({ material }: StageObject, parameter: RedmapParameter, onChange: () => void): HTMLElement[] {
  const { name, type, value, minimum, maximum, unit, meaning, live } = parameter;
  const label = name.replaceAll('_', ' ');
  const set = (next: number[]) => {
    material.setParameter(name, next);
    onChange();
  };
  const rows = isColor(parameter)
    ? [colorRow(label, value, set)]
    : value.map((component, i) =>
        slider(
          {
            label: value.length > 1 ? `${label} ${'xyz'[i]}` : label,
            minimum,
            maximum,
            unit,
            whole: type === 'int',
            logarithmic: minimum > 0 && maximum / minimum > kWide,
          },
          component,
          next => set(material.parameter(name).map((old, j) => (i === j ? next : old))),
        ),
      );
  for (const row of rows) {
    row.title = meaning;
    if (live) continue;
    row.querySelector('.name')!.append(element('span', { className: 'note', title: kBakeNote }, ['bake']));
  }
  return rows;
}

const kBakeNote = 'Moves the pattern: the map keeps the old one until it is baked again; the original follows at once.';

/** Lays out `panel` anew. `onChange`: the picture is another. */
export function layOutPanel(panel: HTMLElement, stage: Stage, onChange: () => void): void {
  const sections: HTMLElement[] = [];
  for (const light of stage.lights)
    sections.push(element('section', {}, [heading('Light', light.description.name), ...lightRows(light, onChange)]));
  for (const object of stage.objects) {
    const { shader, parameters } = object.exported.manifest;
    if (parameters.length === 0) continue;
    const rows = parameters.flatMap(parameter => parameterRows(object, parameter, onChange));
    sections.push(element('section', {}, [heading(shader.replaceAll('_', ' '), object.name), ...rows]));
  }
  const reset = element('button', { type: 'button', textContent: 'Reset', className: 'reset' });
  reset.addEventListener('click', () => {
    for (const { light, description } of stage.lights) {
      light.intensity = 1;
      light.position.set(...description.place);
    }
    for (const { exported, material } of stage.objects)
      for (const { name, value } of exported.manifest.parameters) material.setParameter(name, value);
    layOutPanel(panel, stage, onChange);
    onChange();
  });
  panel.replaceChildren(...sections, reset);
}

function heading(what: string, name: string): HTMLElement {
  return element('h2', {}, [what, name && name !== what ? element('small', {}, [` ${name}`]) : '']);
}
