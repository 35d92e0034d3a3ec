// Shows the results in the element `data`: see testbench/reports/result_page.cpp for its form.
'use strict';
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const $ = (id) => document.getElementById(id);

  // ---- The data -------------------------------------------------------------------------------

  // The values of a column, one for each row, from whichever form they are stored in.
  const unpacked = (column) => 'same' in column ? Array(data.rows).fill(column.same)
      : 'values' in column ? column.values : column.index.map((place) => column.words[place]);

  const columns = data.columns.map((column) => {
    const values = unpacked(column);
    const present = values.filter((value) => value !== null);
    return {
      ...column,
      values,
      first: present.length > 0 ? present[0] : null,
      varies: present.some((value) => value !== present[0]),
      numeric: present.length > 0 && present.every((value) => typeof value === 'number'),
      gaps: present.length < values.length,
      short: column.kind === 'setting' ? column.name.slice(column.name.lastIndexOf('.') + 1)
          : column.name,
    };
  });
  const columnOf = new Map(columns.map((column) => [column.name, column]));
  const chosen = columns.filter((column) => column.kind === 'setting' || column.kind === 'input');
  const varied = chosen.filter((column) => column.varies);
  const metrics = columns.filter((column) => column.kind === 'metric' && column.numeric);
  const all = d3.range(data.rows);

  const outcomes = columnOf.get('outcome');
  const outcomeOf = (row) => outcomes ? outcomes.values[row] : 'passed';
  const hasPassed = (row) => outcomeOf(row) === 'passed';

  // Only runs of one scene compete, with the same content.
  const scenes = columnOf.get('scene_hash') || columnOf.get('scene');
  const sceneOf = (row) => scenes ? scenes.values[row] : '';

  const words = data.commands.map(unpacked);
  const commandOf = (row) => words.map((column) => column[row]).filter((word) => word !== null)
      .join(' ');

  const numberText = (value) => {
    if (Number.isInteger(value)) return value.toLocaleString('en');
    return String(Number(value.toPrecision(4)));
  };
  const text = (column, value) => {
    if (value === null) return '–';
    if (typeof value !== 'number') return value;
    return column.kind === 'metric' ? numberText(value) : String(value);
  };
  const withUnit = (column, value) =>
      text(column, value) + (column.unit && value !== null ? ' ' + column.unit : '');
  const counted = (count) => `${numberText(count)} ${data.row}${count === 1 ? '' : 's'}`;
  // A column by which each row has a name of its own.
  const naming = varied.find((column) =>
      !column.numeric && new Set(column.values).size === data.rows);
  const nameOf = (row) => data.row[0].toUpperCase() + data.row.slice(1) + ' ' +
      (naming ? naming.values[row] : row + 1);

  // ---- What is chosen -------------------------------------------------------------------------

  const filters = new Map();  // from the name of a column to a function that tells what is kept
  let xColumn = metrics.find((column) => column.name === data.x) || metrics[0];
  let yColumn = metrics.find((column) => column.name === data.y) || metrics[1] || metrics[0];
  // The two, or one if they are the same, or none if no run has a result.
  const chosenMetrics = () => [...new Set([xColumn, yColumn])].filter((column) => column);
  let kept = all;
  let fronts = [];  // of each scene
  let front = [];   // all of them
  let sorting = {name: null, ascending: true};
  const rowsAtOnce = 200;
  let rowsShown = rowsAtOnce;

  // The rows that no other beats: none is at least as good in both and better in one. Equal rows
  // stand on the front together. Best in the first measure first.
  function frontOf(rows, first, second) {
    if (!data.alternatives || first.better === 'neither' || second.better === 'neither') return [];
    const a = (row) => first.better === 'less' ? first.values[row] : -first.values[row];
    const b = (row) => second.better === 'less' ? second.values[row] : -second.values[row];
    const order = rows.filter((row) =>
        hasPassed(row) && first.values[row] !== null && second.values[row] !== null);
    order.sort((i, j) => a(i) - a(j) || b(i) - b(j) || i - j);
    const result = [];
    for (const row of order) {
      const last = result[result.length - 1];
      if (last === undefined || b(row) < b(last) || (b(row) === b(last) && a(row) === a(last))) {
        result.push(row);
      }
    }
    return result;
  }

  // ---- Scatter --------------------------------------------------------------------------------

  const symbols = {
    passed: d3.symbol().type(d3.symbolCircle).size(36)(),
    front: d3.symbol().type(d3.symbolDiamond).size(90)(),
    failed: d3.symbol().type(d3.symbolTriangle).size(54)(),
  };
  const scatter = d3.select('#scatter');
  const margin = {top: 14, right: 16, bottom: 48, left: 62};
  const grid = scatter.append('g');
  const axes = scatter.append('g');
  const steps = scatter.append('path').attr('class', 'steps');
  const points = scatter.append('g');
  const labels = scatter.append('g').attr('aria-hidden', 'true');
  const ring = scatter.append('circle').attr('class', 'ring').attr('r', 8).attr('display', 'none');
  let placeOf = new Map();  // from a row to where its point is
  let tree = d3.quadtree();
  let order = [];  // rows with a point, from left to right

  const axisText = (column) => column.name + (column.unit ? `, ${column.unit}` : '') +
      (column.better === 'neither' ? '' : ` (${column.better} is better)`);

  // A scale, with `place`, which gives where a value lies, and `edge`: on a logarithmic axis, what is
  // below it lies on the edge.
  function scaleFor(column, logarithmic, rows, range) {
    const values = rows.map((row) => column.values[row]);
    const [low, high] = values.length > 0 ? d3.extent(values) : [0, 1];
    if (!logarithmic || high <= 0) {
      const room = (high - low) * 0.05 || Math.abs(low) * 0.5 || 1;
      const scale = d3.scaleLinear().domain([low - room, high + room]).range(range);
      return {scale, place: scale, edge: null, logarithmic: false};
    }
    const span = 1e5;
    const edge = low < high / span ? high / span : null;
    const from = edge === null ? low : d3.min(values.filter((value) => value >= edge)) / 2;
    const room = from === high ? 2 : Math.pow(high / from, 0.04);
    const scale = d3.scaleLog().domain([from / room, high * room]).range(range);
    const place = (value) => edge !== null && value < edge ? range[0] : scale(value);
    return {scale, place, edge, logarithmic: true};
  }

  // A logarithmic axis is marked at powers of ten, or as any other where it has few of them.
  function drawAxis(axis, {scale, logarithmic}, ticks) {
    axis.ticks(ticks).tickSizeOuter(0);
    if (!logarithmic) return axis;
    const [low, high] = scale.domain();
    const few = 20, exact = (value) => String(Number(value.toPrecision(6)));
    if (high / low < few) return axis.tickValues(d3.ticks(low, high, ticks)).tickFormat(exact);
    return axis.tickFormat((value) => Number.isInteger(Math.log10(value)) ? exact(value) : '');
  }

  function drawScatter() {
    const width = scatter.node().clientWidth, height = scatter.node().clientHeight;
    const measured = (row) => xColumn.values[row] !== null && yColumn.values[row] !== null;
    const drawable = all.filter(measured);
    const x = scaleFor(xColumn, $('log-x').checked, drawable, [margin.left, width - margin.right]);
    const y = scaleFor(yColumn, $('log-y').checked, drawable, [height - margin.bottom, margin.top]);
    const bottom = height - margin.bottom;

    const across = drawAxis(d3.axisBottom(x.scale), x, Math.max(3, Math.floor(width / 110)));
    const up = drawAxis(d3.axisLeft(y.scale), y, 6);
    axes.html('');
    axes.append('g').attr('transform', `translate(0,${bottom})`).call(across);
    axes.append('g').attr('transform', `translate(${margin.left},0)`).call(up);
    axes.append('text').attr('class', 'title').attr('text-anchor', 'end')
        .attr('x', width - margin.right).attr('y', height - 10).text(axisText(xColumn));
    axes.append('text').attr('class', 'title').attr('text-anchor', 'end')
        .attr('transform', `translate(14,${margin.top}) rotate(-90)`).text(axisText(yColumn));

    const onFront = new Set(front);
    const classOf = (row) => onFront.has(row) ? 'front' : hasPassed(row) ? 'passed' : 'failed';
    const shown = kept.filter(measured);
    // The front is drawn last, so that nothing covers it.
    shown.sort((i, j) => onFront.has(i) - onFront.has(j) || i - j);
    placeOf = new Map(shown.map((row) => [row, [x.place(xColumn.values[row]),
                                                y.place(yColumn.values[row])]]));
    tree = d3.quadtree().x((row) => placeOf.get(row)[0]).y((row) => placeOf.get(row)[1])
        .addAll(shown);
    order = shown.slice().sort((i, j) => placeOf.get(i)[0] - placeOf.get(j)[0] || i - j);
    points.selectAll('path').data(shown, (row) => row).join('path')
        .attr('class', (row) => 'point ' + classOf(row))
        .attr('d', (row) => symbols[classOf(row)])
        .attr('transform', (row) => `translate(${placeOf.get(row)})`)
        .attr('tabindex', -1).attr('role', 'button').order();
    if (order.length > 0) letTabReach(order.find((row) => onFront.has(row)) ?? order[0]);

    const line = d3.line().curve(d3.curveStepAfter);
    steps.attr('d', fronts.filter((rows) => rows.length > 1)
        .map((rows) => line(rows.map((row) => placeOf.get(row)))).join(''));
    ring.attr('display', 'none');
    drawLabels(width);

    const unmeasured = d3.nest().key(outcomeOf).entries(kept.filter((row) => !measured(row)))
        .map(({key, values}) => `${numberText(values.length)} ${key.replace('_', ' ')}`);
    const sentences = [];
    if (!data.alternatives) {
      sentences.push(`No front: one ${data.row} cannot take the place of another.`);
    } else if (xColumn.better === 'neither' || yColumn.better === 'neither') {
      sentences.push('No front: of one of these no direction is better.');
    } else {
      sentences.push(`${numberText(front.length)} of ${counted(
          kept.filter(hasPassed).length)} that passed on the front of what is shown.`);
    }
    if (unmeasured.length > 0) {
      sentences.push(`Not drawn, for they have no such value: ${unmeasured.join(', ')}.`);
    }
    for (const [{edge}, column, where] of [[x, xColumn, 'left'], [y, yColumn, 'lower']]) {
      if (edge === null) continue;
      const count = shown.filter((row) => column.values[row] < edge).length;
      sentences.push(`${numberText(count)} on the ${where} edge: below ${numberText(edge)}.`);
    }
    $('scatter-text').textContent = sentences.join(' ');
  }

  // Names beside points, where these are few and each has its own. What would cover another is left
  // out.
  function drawLabels(width) {
    labels.html('');
    const most = 60;
    if (!naming || data.rows > most) return;
    const reach = 5, letters = 6.9, high = 12, apart = 8;
    const taken = order.map((row) => placeOf.get(row))
        .map(([x, y]) => [x - reach, y - reach, x + reach, y + reach]);
    for (const row of order.slice().sort((i, j) => front.includes(j) - front.includes(i))) {
      const name = naming.values[row];
      if (name === null) continue;
      const [x, y] = placeOf.get(row);
      const wide = letters * name.length;
      // To the right, the left, above, below.
      const boxes = [[x + apart, y - high / 2], [x - apart - wide, y - high / 2],
                     [x - wide / 2, y - apart - high], [x - wide / 2, y + apart]]
          .map(([left, top]) => [left, top, left + wide, top + high]);
      const meets = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
      const free = boxes.find((box) => box[0] > margin.left && box[2] < width &&
          box[3] < scatter.node().clientHeight - margin.bottom + high / 2 && !taken.some((other) => meets(box, other)));
      if (!free) continue;
      taken.push(free);
      labels.append('text').attr('class', 'label').attr('x', free[0]).attr('y', free[1] + high - 2)
          .text(name);
    }
  }

  const nodeOf = (row) => points.selectAll('path').filter((other) => other === row).node();

  // Only one point at a time is in the order of the Tab key; arrow keys go to the others.
  let reached = null;
  function letTabReach(row) {
    if (reached) reached.setAttribute('tabindex', -1);
    reached = nodeOf(row);
    reached.setAttribute('tabindex', 0);
    reached.setAttribute('aria-label', `${nameOf(row)}: ` + describe(row)
        .map(([name, value]) => `${name} ${value}`).join(', '));
  }

  // What tells a run from the others.
  function describe(row) {
    const parts = varied.map((column) => [column.short, withUnit(column, column.values[row])]);
    for (const column of chosenMetrics()) {
      parts.push([column.name, withUnit(column, column.values[row])]);
    }
    if (outcomes) parts.push(['outcome', outcomeOf(row).replace('_', ' ')]);
    return parts;
  }

  function fillList(list, parts) {
    list.replaceChildren();
    for (const [name, value] of parts) {
      const term = document.createElement('dt'), definition = document.createElement('dd');
      term.textContent = name;
      definition.textContent = value;
      list.append(term, definition);
    }
  }

  function point(row) {
    const panel = $('shown');
    panel.replaceChildren();
    const heading = document.createElement('strong');
    if (row === null) {
      heading.textContent = `Point at a ${data.row}, or walk through them with Tab and the arrow ` +
          'keys; click or press Enter to open one.';
      panel.append(heading);
      ring.attr('display', 'none');
      return;
    }
    heading.textContent = nameOf(row) + (front.includes(row) ? ', on the front' : '');
    const list = document.createElement('dl');
    fillList(list, describe(row));
    panel.append(heading, list);
    const place = placeOf.get(row);
    if (place) ring.attr('display', null).attr('cx', place[0]).attr('cy', place[1]);
  }

  const nearest = (event) => {
    const box = scatter.node().getBoundingClientRect();
    const reach = 24;
    return tree.find(event.clientX - box.left, event.clientY - box.top, reach);
  };
  scatter.node().addEventListener('pointermove', (event) => {
    const row = nearest(event);
    if (row !== undefined) point(row);
  });
  scatter.node().addEventListener('click', (event) => {
    const row = nearest(event);
    if (row !== undefined) openRun(row);
  });
  scatter.node().addEventListener('focusin', (event) => {
    const row = d3.select(event.target).datum();
    if (row !== undefined) point(row);
  });
  scatter.node().addEventListener('keydown', (event) => {
    const row = d3.select(event.target).datum();
    if (row === undefined) return;
    const at = order.indexOf(row);
    const steps = {ArrowRight: at + 1, ArrowUp: at + 1, ArrowLeft: at - 1, ArrowDown: at - 1,
                   Home: 0, End: order.length - 1};
    if (event.key in steps) {
      event.preventDefault();
      const next = order[Math.min(Math.max(steps[event.key], 0), order.length - 1)];
      letTabReach(next);
      nodeOf(next).focus();
    } else if (event.key === 'Enter' || event.key === ' ') {
      event.preventDefault();
      openRun(row);
    }
  });

  function fillLegend() {
    const entries = [['passed', 'passed']];
    if (data.alternatives) entries.unshift(['front', 'Pareto front']);
    const measured = (row) => metrics.some((column) => column.values[row] !== null);
    if (all.some((row) => !hasPassed(row) && measured(row))) entries.push(['failed', 'not passed']);
    const legend = d3.select('#legend');
    for (const [name, meaning] of entries) {
      legend.append('svg').attr('viewBox', '-7 -7 14 14').attr('aria-hidden', 'true')
          .append('path').attr('class', name).attr('d', symbols[name]);
      legend.append('span').text(meaning);
    }
  }

  function fillSelects() {
    for (const id of ['x', 'y']) {
      for (const [label, members] of [['differ', metrics.filter((column) => column.varies)],
                                      [`the same in all ${data.row}s`, metrics.filter((column) =>
                                          !column.varies)]]) {
        if (members.length === 0) continue;
        const group = d3.select('#' + id).append('optgroup').attr('label', label);
        for (const column of members) {
          group.append('option').attr('value', column.name).attr('title', column.meaning)
              .text(column.name);
        }
      }
      $(id).value = (id === 'x' ? xColumn : yColumn).name;
      $(id).addEventListener('change', () => {
        const left = id === 'x' ? xColumn : yColumn;
        if (id === 'x') xColumn = columnOf.get($(id).value);
        if (id === 'y') yColumn = columnOf.get($(id).value);
        if (left !== xColumn && left !== yColumn) {
          filters.delete(left.name);
          delete selections[left.name];
        }
        drawParallel();
        update();
      });
      $('log-' + id).addEventListener('change', drawScatter);
    }
  }

  // ---- Parallel coordinates -------------------------------------------------------------------

  const plane = {height: 300, top: 40, bottom: 34, left: 110, right: 76, least: 104};
  const inner = plane.height - plane.top - plane.bottom;
  const canvas = document.querySelector('#parallel canvas');
  const lines = d3.select('#parallel svg');
  let dimensions = [];

  // Numbers lie on a line, anything else at places of its own. What has no value lies below.
  function dimensionOf(column) {
    const range = [plane.top + inner, plane.top];
    let scale;
    if (column.numeric) {
      const [low, high] = d3.extent(column.values.filter((value) => value !== null));
      const room = low === high ? Math.abs(low) / 2 || 1 : 0;
      scale = d3.scaleLinear().domain([low - room, high + room]).range(range);
    } else {
      const different = new Set(column.values.filter((value) => value !== null));
      scale = d3.scalePoint().domain([...different].sort(d3.ascending)).range(range).padding(0.5);
    }
    const heights = column.values.map((value) =>
        value === null ? plane.top + inner + 16 : scale(value));
    return {column, scale, heights};
  }

  // Lines do not run behind the numbers of the first and the last axis: these stand outside.
  function marks(dimension, isLast) {
    const outside = isLast && dimension.column.numeric;
    const axis = (outside ? d3.axisRight : d3.axisLeft)(dimension.scale).tickSizeOuter(0);
    const most = 12;
    if (dimension.column.numeric) {
      const values = [...new Set(dimension.column.values)].filter((value) => value !== null);
      return values.length <= most && dimension.column.kind !== 'metric'
          ? axis.tickValues(values).tickFormat(String) : axis.ticks(6);
    }
    const names = dimension.scale.domain();
    const each = Math.ceil(names.length / most);
    const letters = 12;
    return axis.tickValues(names.filter((name, i) => i % each === 0)).tickFormat((name) =>
        name.length > letters ? '…' + name.slice(1 - letters) : name);
  }

  function drawParallel() {
    dimensions = [...varied, ...chosenMetrics()].map(dimensionOf);
    const width = Math.max($('parallel').clientWidth,
                           plane.left + plane.right + (dimensions.length - 1) * plane.least);
    const between = (width - plane.left - plane.right) / Math.max(dimensions.length - 1, 1);
    dimensions.forEach((dimension, i) => { dimension.x = plane.left + i * between; });
    d3.select('#parallel-inner').style('width', width + 'px').style('height', plane.height + 'px');
    lines.attr('width', width).attr('height', plane.height).html('');
    const dense = window.devicePixelRatio || 1;
    canvas.width = width * dense;
    canvas.height = plane.height * dense;
    canvas.style.width = width + 'px';
    canvas.style.height = plane.height + 'px';
    for (const dimension of dimensions) addAxis(dimension, between);
  }

  function addAxis(dimension, between) {
    const {column, x} = dimension;
    const axis = lines.append('g').attr('class', 'axis').attr('transform', `translate(${x},0)`)
        .attr('data-name', column.name).attr('tabindex', 0).attr('role', 'group')
        .attr('aria-label', `Filter by ${column.name}`);
    axis.call(marks(dimension, dimension === dimensions[dimensions.length - 1]));
    const title = axis.append('text').attr('class', 'title').attr('text-anchor', 'middle')
        .attr('y', 18).text(column.short);
    const wide = title.node().getComputedTextLength();
    const room = Math.min(between, 2 * plane.right) - 6;
    if (wide > room) title.attr('textLength', room).attr('lengthAdjust', 'spacingAndGlyphs');
    axis.append('title').text(column.name + (column.meaning ? ': ' + column.meaning : ''));
    if (column.gaps) {
      axis.append('text').attr('text-anchor', 'middle').attr('y', plane.height - 4).text('none');
    }
    // A little longer than the axis, so that its ends are easily within a selection.
    const half = 14, top = plane.top - 6, bottom = plane.top + inner + 6;
    const brush = d3.brushY().extent([[-half, top], [half, bottom]])
        .on('brush end', () => filterBy(dimension, d3.event.selection));
    const part = axis.append('g').attr('class', 'brush').call(brush);
    dimension.clear = () => part.call(brush.move, null);
    part.on('dblclick', dimension.clear);
    if (dimension.column.name in selections) {
      part.call(brush.move, selections[dimension.column.name]);
    }
    axis.on('keydown', () => {
      const step = inner / 20;
      const [high, low] = selections[column.name] || [top, bottom];
      const key = d3.event.key, turn = {ArrowUp: -step, ArrowDown: step}[key];
      if (key === 'Delete' || key === 'Backspace') dimension.clear();
      if (turn === undefined) return;
      d3.event.preventDefault();
      const within = (y, from, to) => Math.min(Math.max(y, from), to);
      part.call(brush.move, d3.event.shiftKey ? [high, within(low + turn, high + 1, bottom)]
                                              : [within(high + turn, top, low - 1), low]);
    });
  }

  const selections = {};  // from the name of a column to the part of its axis that is kept
  function filterBy({column, heights}, selection) {
    if (selection) {
      selections[column.name] = selection;
      filters.set(column.name, (row) => column.values[row] !== null &&
          heights[row] >= selection[0] && heights[row] <= selection[1]);
    } else {
      delete selections[column.name];
      filters.delete(column.name);
    }
    updateSoon();
  }

  function clearFilters() {
    for (const dimension of dimensions) dimension.clear();
  }

  function drawLines() {
    const style = getComputedStyle(document.documentElement);
    const color = (name) => style.getPropertyValue('--' + name);
    const dense = window.devicePixelRatio || 1;
    const pen = canvas.getContext('2d');
    pen.setTransform(dense, 0, 0, dense, 0, 0);
    pen.clearRect(0, 0, canvas.width, canvas.height);
    const draw = (rows, stroke, width, alpha) => {
      pen.strokeStyle = stroke;
      pen.lineWidth = width;
      pen.globalAlpha = alpha;
      pen.beginPath();
      for (const row of rows) {
        dimensions.forEach(({x, heights}, i) => {
          if (i === 0) pen.moveTo(x, heights[row]);
          else pen.lineTo(x, heights[row]);
        });
      }
      pen.stroke();
    };
    const alpha = Math.max(0.15, Math.min(0.8, 60 / kept.length));
    if (kept.length < all.length) draw(all, color('out'), 1, 1);
    // One path of many lines would be drawn as one, without the lines showing through each other.
    const bundle = 50;
    for (const outcome of ['passed', 'failed']) {
      const rows = kept.filter((row) => hasPassed(row) === (outcome === 'passed'));
      for (let i = 0; i < rows.length; i += bundle) {
        draw(rows.slice(i, i + bundle), color(outcome), 1.1, alpha);
      }
    }
    draw(front, color('front'), 1.8, 0.9);
  }

  // ---- Table ----------------------------------------------------------------------------------

  const compared = (a, b) => a === null ? (b === null ? 0 : 1) : b === null ? -1
      : typeof a === 'number' && typeof b === 'number' ? a - b : d3.ascending(`${a}`, `${b}`);

  function sorted(rows) {
    const column = columnOf.get(sorting.name);
    if (!column) return rows;
    const sign = sorting.ascending ? 1 : -1;
    const values = column.values;
    return rows.slice().sort((i, j) => {
      // What has no value comes last, whichever way.
      if (values[i] === null || values[j] === null) return compared(values[i], values[j]) || i - j;
      return sign * compared(values[i], values[j]) || i - j;
    });
  }

  function tableColumns() {
    if ($('all-columns').checked) return columns.filter((column) => column.varies);
    const result = [...varied, ...chosenMetrics()];
    if (outcomes && outcomes.varies) result.push(outcomes);
    const message = columnOf.get('message');
    if (message && message.varies) result.push(message);
    return result;
  }

  function drawTable() {
    const shownColumns = tableColumns();
    const head = document.createElement('tr');
    const number = document.createElement('th');
    number.scope = 'col';
    number.textContent = 'no.';
    head.append(number);
    for (const column of shownColumns) {
      const cell = document.createElement('th'), button = document.createElement('button');
      const by = sorting.name === column.name;
      cell.scope = 'col';
      cell.className = column.numeric ? 'number' : '';
      cell.setAttribute('aria-sort', !by ? 'none' : sorting.ascending ? 'ascending' : 'descending');
      button.type = 'button';
      button.title = column.meaning;
      button.dataset.name = column.name;
      button.textContent = column.short + (column.unit ? `, ${column.unit}` : '') +
          (by ? (sorting.ascending ? ' ▲' : ' ▼') : '');
      button.addEventListener('click', () => {
        sorting = {name: column.name, ascending: by ? !sorting.ascending : true};
        drawTable();
        for (const other of document.querySelectorAll('thead button')) {
          if (other.dataset.name === column.name) other.focus();
        }
      });
      cell.append(button);
      head.append(cell);
    }
    document.querySelector('thead').replaceChildren(head);

    const onFront = new Set(front);
    const body = document.createDocumentFragment();
    for (const row of sorted(kept).slice(0, rowsShown)) {
      const line = document.createElement('tr'), first = document.createElement('td');
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = `${row + 1}${onFront.has(row) ? ' ◆' : ''}`;
      button.setAttribute('aria-label',
                          `Open ${nameOf(row)}${onFront.has(row) ? ', on the front' : ''}`);
      button.addEventListener('click', () => openRun(row));
      first.append(button);
      line.append(first);
      for (const column of shownColumns) {
        const cell = document.createElement('td'), value = column.values[row];
        cell.className = column.numeric ? 'number' : 'long';
        cell.textContent = text(column, value);
        if (!column.numeric) cell.title = cell.textContent;
        line.append(cell);
      }
      body.append(line);
    }
    // Under a filter the page gets no shorter: it would scroll while the pointer drags.
    const table = $('table');
    table.style.minHeight = filters.size > 0 ? `${table.offsetHeight}px` : '';
    document.querySelector('tbody').replaceChildren(body);
    $('count').textContent = `${numberText(kept.length)} of ${counted(data.rows)}` +
        (kept.length > rowsShown ? `, the first ${rowsShown} shown` : '');
    $('more').hidden = kept.length <= rowsShown;
  }

  // ---- Files to take away ---------------------------------------------------------------------

  function save(name, type, content) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([content], {type}));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }
  const fileName = data.title.replace(/[^A-Za-z0-9._-]+/g, '-').replace(/^[-.]+|[-.]+$/g, '') ||
      'results';

  function csv() {
    const cell = (value) => {
      const plain = value === null ? '' : String(value);
      return /[",\n\r]/.test(plain) ? `"${plain.replace(/"/g, '""')}"` : plain;
    };
    const withCommands = words.length > 0;
    const head = columns.map((column) => column.name).concat(withCommands ? 'command' : []);
    const rows = sorted(kept).map((row) => columns.map((column) => column.values[row])
        .concat(withCommands ? commandOf(row) : []));
    return [head, ...rows].map((row) => row.map(cell).join(',') + '\n').join('');
  }

  // A hardware file, as --hardware reads it.
  function toml(row) {
    let result = '', section = '';
    const settings = columns.filter((column) =>
        column.kind === 'setting' && column.values[row] !== null);
    // Keys without a section come before the first of them.
    const split = (column) => [column.name.slice(0, Math.max(column.name.lastIndexOf('.'), 0)),
                               column.short];
    settings.sort((a, b) => d3.ascending(split(a)[0], split(b)[0]));
    for (const column of settings) {
      const [own, key] = split(column);
      if (own !== section) result += `\n[${section = own}]\n`;
      const value = column.values[row];
      result += `${key} = ${typeof value === 'number' ? value : JSON.stringify(value)}\n`;
    }
    return result;
  }

  // ---- One run --------------------------------------------------------------------------------

  let opened = 0;
  function openRun(row) {
    opened = row;
    $('run-heading').textContent = nameOf(row) + (front.includes(row) ? ', on the front' : '') +
        (outcomes ? ': ' + outcomeOf(row).replace('_', ' ') : '');
    const pictures = data.pictures[row] || [];
    $('pictures').replaceChildren(...pictures.map(([label, place]) => {
      const figure = document.createElement('figure'), image = document.createElement('img');
      const caption = document.createElement('figcaption');
      image.src = data.images[place];
      image.alt = `${label} of ${nameOf(row)}`;
      caption.textContent = label === 'error map'
          ? 'error map: black 0, blue 1, red 2, yellow 3, white 4 LSB and more; green: not covered'
          : label;
      figure.append(image, caption);
      return figure;
    }));
    if (pictures.length === 0 && data.images.length > 0) {
      $('pictures').textContent = `No pictures of this ${data.row} are kept in the page.`;
    }
    $('command-part').hidden = commandOf(row) === '';
    $('command').textContent = commandOf(row);
    $('copy').textContent = 'Copy the command';
    const hasHardware = columns.some((column) =>
        column.kind === 'setting' && column.values[row] !== null);
    $('toml').parentElement.hidden = !hasHardware;
    const list = columns.filter((column) => column.values[row] !== null &&
        column.values[row] !== '' && (column.varies || column.kind === 'metric'));
    fillList($('values'), list.map((column) =>
        [column.name, withUnit(column, column.values[row])]));
    $('run').showModal();
    $('run-heading').focus();
    $('run').scrollTop = 0;
  }

  async function copyCommand() {
    try {
      await navigator.clipboard.writeText($('command').textContent);
      $('copy').textContent = 'Copied';
    } catch (error) {
      // Not allowed here: the text is selected, to be copied by hand.
      getSelection().selectAllChildren($('command'));
      $('copy').textContent = 'Selected: press Ctrl+C';
    }
  }

  // ---- All together ---------------------------------------------------------------------------

  function update() {
    const tests = [...filters.values()];
    kept = tests.length === 0 ? all : all.filter((row) => tests.every((test) => test(row)));
    fronts = metrics.length > 0
        ? d3.nest().key(sceneOf).entries(kept).map(({values}) => frontOf(values, xColumn, yColumn))
        : [];
    front = d3.merge(fronts);
    rowsShown = rowsAtOnce;
    $('clear').disabled = tests.length === 0;
    if (metrics.length > 0) drawScatter();
    drawLines();
    drawTable();
  }

  // Brushes move more often than the screen is drawn.
  let waiting = false;
  function updateSoon() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      update();
    });
  }

  function begin() {
    document.querySelector('main').hidden = false;
    document.querySelector('main section').hidden = metrics.length === 0;
    if (metrics.length > 0) {
      $('log-x').checked = $('log-y').checked = data.logarithmic;
      fillSelects();
      fillLegend();
    }
    fillList(document.querySelector('#common dl'), columns.filter((column) =>
        !column.varies && column.first !== null && column.first !== '')
        .map((column) => [column.name, withUnit(column, column.first)]));
    fillList(document.querySelector('#meanings dl'), columns.filter((column) => column.meaning)
        .map((column) => [column.name + (column.unit ? `, ${column.unit}` : ''), column.meaning]));
    $('text').hidden = document.querySelector('#text pre').textContent === '';
    $('clear').addEventListener('click', clearFilters);
    $('all-columns').addEventListener('change', drawTable);
    $('more').addEventListener('click', () => {
      rowsShown += rowsAtOnce;
      drawTable();
    });
    $('csv').addEventListener('click', () => save(fileName + '.csv', 'text/csv', csv()));
    $('toml').addEventListener('click', () =>
        save(`${fileName}-${opened + 1}.toml`, 'application/toml', toml(opened)));
    $('copy').addEventListener('click', copyCommand);
    document.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' && !$('run').open) clearFilters();
    });
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', drawLines);
    addEventListener('beforeprint', drawLines);
    point(null);
    drawParallel();
    update();
    let width = innerWidth;
    addEventListener('resize', () => {
      if (innerWidth === width) return;
      width = innerWidth;
      drawParallel();
      updateSoon();
    });
  }

  begin();
})();
