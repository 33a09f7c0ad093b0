% A textbook Kalman filter in Octave (7 or later) as a subject: exact-kalman check -- octave --quiet textbook.m
1;  % a file of functions and commands

function x = number(text)
  x = str2double (text);
  if (isnan (x) && ! strcmpi (text, "nan"))
    error ("subject:unsupported", "Octave reads no hexadecimal floats");
  end
end

function d = depth(value)
  d = 0;
  if (iscell (value))
    d = 1 + max ([0, cellfun(@depth, value(:)')]);
  end
end

% jsondecode makes a list of nulls alone an array that is not a cell.
function items = list(value)
  items = value(:)';
  if (! iscell (value))
    items = cell (1, numel (value));
  end
end

% The value at k of a constant, or of a list with one value per observation.
function m = at(value, deep, k)
  if (depth (value) > deep || any (cellfun (@isempty, list (value))))
    value = value{k};
  end
  if (deep == 2)
    m = cell2mat (cellfun (@(row) cellfun (@number, list (row)), list (value)', "UniformOutput", false));
  else
    m = cellfun (@number, list (value))';
  end
end

% B u.
function x = added(case_, name, size, k)
  x = zeros (size, 1);
  if (isfield (case_, name))
    term = case_.(name);
    x = at (term.vector, 1, k);
    if (isfield (term, "matrix"))
      x = at (term.matrix, 2, k) * x;
    end
  end
end

% Q, cov(process noise, observation noise), R; the first two not where no observation depends on them.
function [q, s, r] = law(noise, n, m, k, with_transition)
  q = zeros (n); s = zeros (n, m);
  if (isfield (noise, "process_factor"))
    f = at (noise.observation_factor, 2, k);
    r = f * f';
    if (with_transition)
      d = at (noise.process_factor, 2, k);
      q = d * d'; s = d * f';
    end
    return
  end
  r = at (noise.observation, 2, k);
  if (with_transition)
    q = at (noise.process, 2, k);
    if (isfield (noise, "cross"))
      s = at (noise.cross, 2, k);
    end
  end
end

function t = text_of(x, is_vector)
  row = @(entries) ["[", strjoin(arrayfun (@(e) sprintf ('"%.17g"', e), entries(:)', "UniformOutput", false), ","), "]"];
  if (is_vector)
    t = row (x);
  else
    t = ["[", strjoin(cellfun (row, num2cell (x, 2)', "UniformOutput", false), ","), "]"];
  end
end

function out = laws_of(when, x, p)
  out = sprintf ('"%s_mean":%s,"%s_covariance":%s', when, text_of (x, true), when, text_of (p, false));
end

function [done, trouble] = steps(c)
  done = {}; trouble = [];
  try
    arriving = strcmp (c.timing, "arriving");
    readings = list (c.observations);
    x = at (c.initial.mean, 1, 1); p = at (c.initial.covariance, 2, 1);
    n = numel (x); m = rows (at (c.observation, 2, 1));
    for k = 1:numel (readings)
      leads_here = arriving && (k > 1 || strcmp (c.initial.before, "transition"));
      leaves = ! arriving && k < numel (readings);
      [q, s, r] = law (c.noise, n, m, k, leads_here || leaves);
      if (leads_here || leaves)
        a = at (c.transition, 2, k); u = added (c, "input", n, k);
      end
      if (leads_here)
        x = a * x + u; p = a * p * a' + q;
      end
      step = laws_of ("predicted", x, p);
      reading = list (readings{k});
      seen = find (! cellfun (@isempty, reading));
      if (! isempty (seen))
        h = at (c.observation, 2, k)(seen, :); s = s(:, seen);
        shared = s * leads_here;  % cov(x_k, noise of y_k)
        cov_xy = p * h' + shared;
        var_y = h * cov_xy + r(seen, seen) + (h * shared)';
        e = cellfun (@number, reading(seen))' - h * x - added (c, "observation_input", m, k)(seen);
        gain = cov_xy / var_y;
        if (! all (isfinite (gain(:))))
          error ("the innovation covariance is singular");
        end
        x = x + gain * e; p = p - gain * cov_xy'; p = (p + p') / 2;
      end
      done{end + 1} = ["{", step, ",", laws_of("filtered", x, p), "}"];
      if (leaves)
        x = a * x + u; p = a * p * a' + q;
        if (! isempty (seen))  % what y_k tells about the noise of the transition that follows
          weight = s / var_y; mixed = a * gain * s';
          x = x + weight * e; p = p - mixed - mixed' - weight * s';
        end
      end
      p = (p + p') / 2;
    end
  catch reason
    trouble = reason;
  end
end

function line = answer(c)
  id = jsonencode (c.id);
  if (! strcmp (c.numbers, "binary64"))
    line = sprintf ('{"id":%s,"outcome":"unsupported","message":"doubles only"}', id);
    return
  end
  [done, trouble] = steps (c);
  outcome = '"answered"';
  if (! isempty (trouble) && strcmp (trouble.identifier, "subject:unsupported"))
    outcome = sprintf ('"unsupported","message":%s', jsonencode (trouble.message)); done = {};
  elseif (! isempty (trouble))
    outcome = sprintf ('"error","step":%d,"message":%s', numel (done), jsonencode (trouble.message));
  end
  line = sprintf ('{"id":%s,"outcome":%s,"steps":[%s]}', id, outcome, strjoin (done, ","));
end

function say(line)
  fputs (stdout, [line, "\n"]);
  fflush (stdout);
end

warning ("off", "all");
name = jsonencode (["textbook, Octave " version()]);
say (['{"format":"exact-kalman/subject/1","name":', name, ',"unsupported":["diffuse"]}']);
while (true)
  try
    line = input ("", "s");  % fgetl would wait for the first byte of the next line
  catch
    exit (0);  % the end of the input
  end
  say (answer (jsondecode (line)));
end
