// Where a drawing is pointed at.
export interface Pixel {
  x: number
  y: number
}

export class Pointing {
  /** From the drawing's upper left corner; null while there is no pointer. */
  at = $state.raw<Pixel | null>(null)

  /** A move or a press on the drawing that handles the event. */
  readonly over = (event: PointerEvent): Pixel => {
    const box = (event.currentTarget as Element).getBoundingClientRect()
    this.at = { x: event.clientX - box.left, y: event.clientY - box.top }
    return this.at
  }

  // A finger leaves as it is lifted: what it pointed at stays to be read.
  readonly leave = ({ pointerType }: PointerEvent): void => {
    if (pointerType !== 'touch') this.at = null
  }
}
