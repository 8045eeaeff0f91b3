(** * rgb-transfer: Colour transfer functions of a field that rises and falls

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Module red.

Definition field (lambda : R) : R :=
  1 + 4 * lambda * (1 - lambda).
Definition extinction (s : R) : R :=
  s.
Definition emission (s : R) : R :=
  1.
Definition exact_depth (lambda : R) : R :=
  lambda + 2 * lambda ^ 2 - 4 / 3 * lambda ^ 3.
Definition exact_radiance (lambda : R) : R :=
  1 - exp (- lambda - 2 * lambda ^ 2 + 4 / 3 * lambda ^ 3).

Theorem rgb_transfer_red (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End red.

Module green.

Definition field (lambda : R) : R :=
  1 + 4 * lambda * (1 - lambda).
Definition extinction (s : R) : R :=
  s.
Definition emission (s : R) : R :=
  1 / 2 * s ^ 2 + 8 / s.
Definition exact_depth (lambda : R) : R :=
  lambda + 2 * lambda ^ 2 - 4 / 3 * lambda ^ 3.
Definition exact_radiance (lambda : R) : R :=
  9 / 2 - (1 / 2 * (1 + 4 * lambda - 4 * lambda ^ 2) ^ 2 + 4 - 8 * lambda) * exp (- lambda - 2 * lambda ^ 2 + 4 / 3 * lambda ^ 3).

Theorem rgb_transfer_green (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End green.

Module blue.

Definition field (lambda : R) : R :=
  1 + 4 * lambda * (1 - lambda).
Definition extinction (s : R) : R :=
  s.
Definition emission (s : R) : R :=
  1 / 3 * s ^ 3 + 32 - 32 / s.
Definition exact_depth (lambda : R) : R :=
  lambda + 2 * lambda ^ 2 - 4 / 3 * lambda ^ 3.
Definition exact_radiance (lambda : R) : R :=
  37 / 3 - (8 + 1 / 3 * (1 + 4 * lambda - 4 * lambda ^ 2) ^ 3 + (1 + 4 * lambda - 4 * lambda ^ 2) * (4 - 8 * lambda)) * exp (- lambda - 2 * lambda ^ 2 + 4 / 3 * lambda ^ 3).

Theorem rgb_transfer_blue (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End blue.
