/* Goal: a window of time never leaves the ride, however it is zoomed or moved. */
import { expect, it } from 'vitest'
import { TraceWindow } from './trace_window.svelte'

it('zooms about its middle and stays within the ride', () => {
  const view = new TraceWindow(100)
  expect(view.is_complete).toBe(true)

  view.zoom(0.5, 800)
  expect(view.window).toEqual({ from_s: 25, to_s: 75 })
  view.pan(1, 800)
  expect(view.window).toEqual({ from_s: 50, to_s: 100 })
  view.zoom(4, 800)
  expect(view.is_complete).toBe(true)
})

it('begins at the window of an address', () => {
  expect(new TraceWindow(100, { from_s: 90, to_s: 400 }).window).toEqual({ from_s: 90, to_s: 100 })
})
