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

function m = read(value, deep)
  if (deep == 2)
    m = cell2mat (cellfun (@(row) cellfun (@number, list (row)), list (value)', "UniformOutput", false));
  else
    m = cellfun (@number, list (value))';
  end
end

% The function k -> value of a constant, read once, or of a list with one value per observation.
function f = along(value, deep)
  if (depth (value) > deep || any (cellfun (@isempty, list (value))))
    f = @(k) read (value{k}, deep);
  else
    m = read (value, deep);
    f = @(k) m;
  end
end

% The function k -> B u.
function f = added(case_, name, size)
  f = @(k) zeros (size, 1);
  if (isfield (case_, name))
    term = case_.(name);
    f = along (term.vector, 1);
    if (isfield (term, "matrix"))
      u = f; b = along (term.matrix, 2);
      f = @(k) b(k) * u(k);
    end
  end
end

% The functions k -> Q, k -> cov(process noise, observation noise), k -> R.
function [q, s, r] = law(noise, n, m)
  if (isfield (noise, "process_factor"))
    d = along (noise.process_factor, 2); f = along (noise.observation_factor, 2);
    q = @(k) d(k) * d(k)'; s = @(k) d(k) * f(k)'; r = @(k) f(k) * f(k)';
    return
  end
  q = along (noise.process, 2); r = along (noise.observation, 2);
  s = @(k) zeros (n, m);
  if (isfield (noise, "cross"))
    s = along (noise.cross, 2);
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
    x = read (c.initial.mean, 1); p = read (c.initial.covariance, 2);
    a_at = along (c.transition, 2); h_at = along (c.observation, 2);
    n = numel (x); m = rows (h_at(1));
    u_at = added (c, "input", n); v_at = added (c, "observation_input", m);
    [q_at, s_at, r_at] = law (c.noise, n, m);
    for k = 1:numel (readings)
      leads_here = arriving && (k > 1 || strcmp (c.initial.before, "transition"));
      leaves = ! arriving && k < numel (readings);
      if (leads_here || leaves)  % no other is there in every list
        a = a_at(k); u = u_at(k); q = q_at(k); s = s_at(k);
      else
        s = zeros (n, m);
      end
      if (leads_here)
        x = a * x + u; p = a * p * a' + q;
      end
      step = laws_of ("predicted", x, p);
      reading = list (readings{k});
      seen = find (! cellfun (@isempty, reading));
      if (! isempty (seen))
        h = h_at(k)(seen, :); r = r_at(k)(seen, seen); s = s(:, seen);
        shared = s * leads_here;  % cov(x_k, noise of y_k)
        cov_xy = p * h' + shared;
        var_y = h * cov_xy + r + (h * shared)';
        e = cellfun (@number, reading(seen))' - h * x - v_at(k)(seen);
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
