// Colours for values: each is found between the few of a scale.
type Colour = readonly [red: number, green: number, blue: number]
export type ColourScale = readonly Colour[]

const scale = (...colours: string[]): ColourScale =>
  colours.map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)) as never)

/** Viridis of matplotlib: from dark to bright, also for colour-blind readers. */
export const VIRIDIS = scale(
  ...['440154', '482475', '414487', '355f8d', '2a788e', '21918c'],
  ...['22a884', '44bf70', '7ad151', 'bddf26', 'fde725'],
)
/** RdBu of ColorBrewer, turned round: less is blue, none is pale, more is red. */
export const BLUE_TO_RED = scale(
  ...['2166ac', '67a9cf', 'd1e5f0', 'f7f7f7', 'fddbc7', 'ef8a62', 'b2182b'],
)

/** The colour at a share of the scale; outside 0 to 1 that of its end. */
export function colourAt(scale: ColourScale, share: number): Colour {
  const place = Math.min(1, Math.max(0, share)) * (scale.length - 1)
  const low = Math.min(Math.floor(place), scale.length - 2)
  const [from = scale[0], to = scale[0]] = [scale[low], scale[low + 1]]
  const between = (i: 0 | 1 | 2) =>
    Math.round((from?.[i] ?? 0) + (place - low) * ((to?.[i] ?? 0) - (from?.[i] ?? 0)))
  return [between(0), between(1), between(2)]
}

export const cssColour = (colour: Colour) => `rgb(${colour.join(' ')})`
