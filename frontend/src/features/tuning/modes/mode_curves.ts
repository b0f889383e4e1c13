// What the curve of a mode is drawn for: a steady push, at each of these speeds.
export const PUSH_NM = 30
export const SPEEDS_KMH = Array.from({ length: 28 }, (_, i) => i + 1)
